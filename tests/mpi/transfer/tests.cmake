pliant_test(mls_sampler_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/mls_sampler_test.cpp LIBS pliant_transfer RANKS 1 2 3 4)
