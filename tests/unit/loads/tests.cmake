pliant_test(drag_area_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/drag_area_test.cpp LIBS pliant_loads)
