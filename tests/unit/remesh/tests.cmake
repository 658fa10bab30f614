if(PLIANT_CGAL)
  pliant_test(remesh_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/remesh_test.cpp LIBS pliant_remesh GTest::gmock)
endif()
