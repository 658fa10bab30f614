pliant_test(core_byte_stream_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/byte_stream_test.cpp LIBS pliant_core)
