set(dir ${CMAKE_CURRENT_LIST_DIR})
pliant_test(placement_test SOURCES ${dir}/placement_test.cpp ${dir}/overlap_test.cpp LIBS pliant_structure GTest::gmock)
pliant_test(structure_test SOURCES ${dir}/advance_vertices_test.cpp ${dir}/stable_time_step_test.cpp ${dir}/make_body_test.cpp
    ${dir}/select_vertices_test.cpp ${dir}/body_forces_test.cpp
  LIBS pliant_structure)
target_include_directories(structure_test PRIVATE ${CMAKE_SOURCE_DIR}/tests)
pliant_test(motion_test SOURCES ${dir}/quaternion_test.cpp ${dir}/rigid_body_test.cpp ${dir}/mass_properties_test.cpp
  ${dir}/hinge_test.cpp ${dir}/prescribed_motion_test.cpp LIBS pliant_structure)
pliant_test(repulsion_test SOURCES ${dir}/repulsion_test.cpp LIBS pliant_structure)
pliant_test(network_moduli_test SOURCES ${dir}/network_moduli_test.cpp LIBS pliant_structure)
target_include_directories(network_moduli_test PRIVATE ${CMAKE_SOURCE_DIR}/tests)
pliant_test(surface_contact_test SOURCES ${dir}/surface_contact_test.cpp LIBS pliant_structure)
