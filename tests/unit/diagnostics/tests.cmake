pliant_test(shape_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/shape_test.cpp LIBS pliant_diagnostics)
pliant_test(inside_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/inside_test.cpp LIBS pliant_diagnostics)
