# Worlds that several processes grow together: a module, which the program opens when mpiexec or srun started it.
set(ESPALIER_MPI AUTO CACHE STRING "grow a world on the ranks of MPI: ON, OFF, or AUTO where MPI is found")
find_package(MPI QUIET COMPONENTS C)
if(ESPALIER_MPI STREQUAL "ON" OR (ESPALIER_MPI STREQUAL "AUTO" AND MPI_C_FOUND))
  find_package(MPI REQUIRED COMPONENTS C)
  add_library(espalier_ranks MODULE src/app/ranks/mpi_ranks.cpp)
  # Without the bindings of C++ that MPI gave up.
  target_compile_definitions(espalier_ranks PRIVATE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  target_link_libraries(espalier_ranks PRIVATE espalier_options espalier_core MPI::MPI_C)
  add_dependencies(espalier_program espalier_ranks)
  set_target_properties(espalier_ranks PROPERTIES INSTALL_RPATH $ORIGIN/..)
  install(TARGETS espalier_ranks DESTINATION ${CMAKE_INSTALL_LIBDIR}/espalier COMPONENT program)
endif()
