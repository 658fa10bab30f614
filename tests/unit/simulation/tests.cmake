pliant_test(time_step_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/time_step_test.cpp LIBS pliant_simulation)
pliant_test(wall_clock_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/wall_clock_test.cpp LIBS pliant_simulation)
pliant_test(ejection_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/ejection_test.cpp LIBS pliant_simulation GTest::gmock)
