set(dir ${CMAKE_CURRENT_LIST_DIR})
pliant_test(placement_test SOURCES ${dir}/placement_test.cpp ${dir}/overlap_test.cpp LIBS pliant_structure GTest::gmock)
pliant_test(structure_test SOURCES ${dir}/advance_vertices_test.cpp ${dir}/stable_time_step_test.cpp ${dir}/make_body_test.cpp
  LIBS pliant_structure)
target_include_directories(structure_test PRIVATE ${CMAKE_SOURCE_DIR}/tests)
