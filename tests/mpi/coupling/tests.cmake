pliant_test(coupling_all_motions_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/all_motions_test.cpp LIBS pliant_simulation
  RANKS 1 2 3 4)
pliant_test(coupling_many_bodies_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/many_bodies_test.cpp LIBS pliant_simulation
  RANKS 1 4)
pliant_test(coupling_contact_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/contact_test.cpp LIBS pliant_simulation RANKS 1 3)
pliant_test(coupling_schemes_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/schemes_test.cpp LIBS pliant_simulation RANKS 1 3)
pliant_test(aitken_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/aitken_test.cpp LIBS pliant_coupling RANKS 1 2 3 4)
pliant_test(hinge_coupling_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/hinge_coupling_test.cpp LIBS pliant_simulation RANKS 1 2 3 4)
target_include_directories(hinge_coupling_test PRIVATE ${CMAKE_SOURCE_DIR}/tests)
pliant_test(coupling_sheet_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/sheet_test.cpp LIBS pliant_simulation RANKS 1 3)
target_include_directories(coupling_sheet_test PRIVATE ${CMAKE_SOURCE_DIR}/tests)
pliant_test(coupling_soft_bodies_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/soft_bodies_test.cpp LIBS pliant_simulation
  RANKS 1 2 3 4)
pliant_test(deformable_contact_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/deformable_contact_test.cpp LIBS pliant_simulation
  RANKS 1 2 3 4)
pliant_test(coupling_interface_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/interface_test.cpp LIBS pliant_simulation RANKS 1 3)
target_include_directories(coupling_interface_test PRIVATE ${CMAKE_SOURCE_DIR}/tests)
pliant_test(coupling_schedule_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/schedule_test.cpp LIBS pliant_simulation RANKS 1 3)
pliant_test(coupling_scales_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/scales_test.cpp LIBS pliant_simulation RANKS 1 2)
pliant_test(coupling_wall_shear_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/wall_shear_test.cpp LIBS pliant_simulation
  RANKS 1 2 3 4)
pliant_test(coupling_walls_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/walls_test.cpp LIBS pliant_simulation RANKS 1 2 3 4)
pliant_test(coupling_tight_walls_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/tight_walls_test.cpp LIBS pliant_simulation
  RANKS 1 2 3 4)
