set(dir ${CMAKE_CURRENT_LIST_DIR})
pliant_test(potentials_test SOURCES ${dir}/gradient_test.cpp ${dir}/closed_form_test.cpp ${dir}/surface_tension_test.cpp
  ${dir}/moduli_test.cpp ${dir}/membrane_test.cpp LIBS pliant_potentials)
target_include_directories(potentials_test PRIVATE ${CMAKE_SOURCE_DIR}/tests)
