pliant_test(hamming_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/hamming_test.cpp LIBS pliant_coupling)
pliant_test(swing_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/swing_test.cpp LIBS pliant_coupling)
pliant_test(added_mass_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/added_mass_test.cpp LIBS pliant_coupling)
pliant_test(local_mass_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/local_mass_test.cpp LIBS pliant_coupling)
