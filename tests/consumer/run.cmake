# Installs the development files to a fresh prefix, then configures, builds and runs the outside project and the examples against it:
# a new representation, and a field from the file of a surface (here an octahedron).
get_filename_component(examples ${SOURCE_DIR}/../../studies/examples ABSOLUTE)
set(prefix ${BUILD_DIR}/consumer/prefix)
set(surface ${BUILD_DIR}/consumer/octahedron.off)
set(field ${BUILD_DIR}/consumer/field.vtu)
file(REMOVE_RECURSE ${prefix} ${field})
file(WRITE ${surface} "OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n"
  "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n")
foreach(command
    "${CMAKE_COMMAND} --install ${BUILD_DIR} --component development --prefix ${prefix}"
    "${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${BUILD_DIR}/consumer/build -G Ninja -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Debug -DEXAMPLES_DIR=${examples}"
    "${CMAKE_COMMAND} --build ${BUILD_DIR}/consumer/build"
    "${BUILD_DIR}/consumer/build/consumer"
    "${BUILD_DIR}/consumer/build/new_representation/check_sh6"
    "${BUILD_DIR}/consumer/build/field_from_surface/field_from_surface ${surface} ${field}")
  separate_arguments(words UNIX_COMMAND "${command}")
  execute_process(COMMAND ${words} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
if(NOT EXISTS ${field})
  message(FATAL_ERROR "field_from_surface wrote no file")
endif()
