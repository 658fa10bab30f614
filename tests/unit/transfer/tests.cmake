pliant_test(mls_shape_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/mls_shape_test.cpp LIBS pliant_transfer)
target_include_directories(mls_shape_test PRIVATE ${CMAKE_SOURCE_DIR}/tests)
pliant_test(marker_refinement_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/marker_refinement_test.cpp LIBS pliant_transfer)
pliant_test(reached_rows_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/reached_rows_test.cpp LIBS pliant_transfer)
