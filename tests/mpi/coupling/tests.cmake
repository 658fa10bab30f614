pliant_test(aitken_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/aitken_test.cpp LIBS pliant_coupling RANKS 1 2 3 4)
