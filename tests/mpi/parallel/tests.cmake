pliant_test(exchange_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/exchange_test.cpp LIBS pliant_parallel RANKS 1 2 3 4)
