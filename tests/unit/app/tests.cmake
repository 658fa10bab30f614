pliant_test(shear_calibration_test
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/maffettone_minale_test.cpp ${CMAKE_CURRENT_LIST_DIR}/shear_calibration_test.cpp
    ${CMAKE_SOURCE_DIR}/src/app/maffettone_minale.cpp ${CMAKE_SOURCE_DIR}/src/app/shear_calibration.cpp
  LIBS pliant_config)
