find_program(PLIANT_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(PLIANT_PYTHON NAMES python3 REQUIRED)
foreach(script bad_input bench_transfer examples failing_run restart units)
  add_test(NAME regression.${script}
    COMMAND ${PLIANT_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/${script}.py $<TARGET_FILE:pliant> ${PLIANT_MPIRUN})
  set_tests_properties(regression.${script} PROPERTIES TIMEOUT 600 PROCESSORS 2)
endforeach()
add_test(NAME regression.body_faults
  COMMAND ${PLIANT_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/body_faults.py $<TARGET_FILE:pliant> ${PLIANT_MPIRUN})
set_tests_properties(regression.body_faults PROPERTIES TIMEOUT 600 PROCESSORS 3)
