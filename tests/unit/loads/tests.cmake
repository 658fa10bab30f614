pliant_test(surface_traction_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/surface_traction_test.cpp LIBS pliant_loads)
