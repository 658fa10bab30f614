set(dir ${CMAKE_CURRENT_LIST_DIR})
pliant_test(mesh_test SOURCES ${dir}/triangle_mesh_test.cpp ${dir}/geometry_test.cpp ${dir}/icosphere_test.cpp
  ${dir}/formats_test.cpp ${dir}/ply_test.cpp ${dir}/check_mesh_test.cpp
  ${dir}/shapes_test.cpp ${dir}/heart_shapes_test.cpp ${dir}/crossing_test.cpp ${dir}/box_cells_test.cpp ${dir}/lids_test.cpp LIBS pliant_mesh)
