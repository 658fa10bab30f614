pliant_test(io_field_writer_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/io_field_writer_test.cpp LIBS pliant_io RANKS 1 2 3 4)
pliant_test(io_simulation_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/io_simulation_test.cpp LIBS pliant_simulation RANKS 1 2 3 4)
pliant_test(io_restart_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/io_restart_test.cpp LIBS pliant_simulation RANKS 1 4)
pliant_test(io_body_restart_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/body_restart_test.cpp LIBS pliant_simulation RANKS 1 4)
