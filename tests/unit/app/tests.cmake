pliant_test(maffettone_minale_test
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/maffettone_minale_test.cpp ${CMAKE_SOURCE_DIR}/src/app/maffettone_minale.cpp
  LIBS pliant_core)
