foreach(name taylor_green channel invariants cavity open_flow patch_flow)
  pliant_test(${name}_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/${name}_test.cpp LIBS pliant_flow)
endforeach()

pliant_test(pumped_tube_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/pumped_tube_test.cpp LIBS pliant_simulation)
