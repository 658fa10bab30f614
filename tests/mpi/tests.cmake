pliant_test(poisson_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/poisson_test.cpp LIBS pliant_solvers RANKS 1 2 3 4 5)
pliant_test(rank_independence_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/rank_independence_test.cpp LIBS pliant_flow
  RANKS 1 2 3 4)
pliant_test(flow_record_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/flow_record_test.cpp LIBS pliant_flow RANKS 1 2 3 4)
pliant_test(flow_patches_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/flow_patches_test.cpp LIBS pliant_flow RANKS 1 2 3 4)
pliant_test(sweeps_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/sweeps_test.cpp LIBS pliant_flow RANKS 1 2 3 4)
