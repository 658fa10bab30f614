pliant_test(drag_area_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/drag_area_test.cpp LIBS pliant_loads)
pliant_test(traction_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/traction_test.cpp LIBS pliant_loads)
pliant_test(one_way_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/one_way_test.cpp LIBS pliant_coupling pliant_diagnostics)
