pliant_test(centered_flow_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/centered_flow_test.cpp
  ${CMAKE_CURRENT_LIST_DIR}/cavity_flow_test.cpp LIBS pliant_diagnostics RANKS 1 2 3 4)
