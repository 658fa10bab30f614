pliant_test(stretching_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/stretching_test.cpp LIBS pliant_grid)
