pliant_test(io_files_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/files_test.cpp LIBS pliant_io)
pliant_test(io_surface_writer_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/surface_writer_test.cpp LIBS pliant_io)
pliant_test(io_resume_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/resume_test.cpp LIBS pliant_io)
