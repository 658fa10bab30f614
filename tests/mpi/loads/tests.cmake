pliant_test(moving_sphere_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/moving_sphere_test.cpp LIBS pliant_loads RANKS 1 2)
