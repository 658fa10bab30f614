pliant_test(shape_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/shape_test.cpp LIBS pliant_diagnostics)
