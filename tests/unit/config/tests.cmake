pliant_test(config_test
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/read_case_test.cpp ${CMAKE_CURRENT_LIST_DIR}/reference_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/surface_keys_test.cpp
  LIBS pliant_config GTest::gmock)
target_compile_definitions(config_test PRIVATE PLIANT_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
pliant_test(config_patches_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/patches_test.cpp LIBS pliant_config GTest::gmock)
pliant_test(config_motions_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/motions_test.cpp LIBS pliant_config GTest::gmock)
pliant_test(config_cavities_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/cavity_keys_test.cpp LIBS pliant_config GTest::gmock)
pliant_test(config_structure_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/structure_keys_test.cpp LIBS pliant_config GTest::gmock)
pliant_test(config_units_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/units_test.cpp LIBS pliant_config GTest::gmock)
