pliant_test(line_solvers_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/line_solvers_test.cpp LIBS pliant_solvers)
