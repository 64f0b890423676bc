# Installs the development files to a fresh prefix, then configures, builds and runs the outside project and the example of a new
# representation against it.
get_filename_component(example ${SOURCE_DIR}/../../studies/examples/new_representation ABSOLUTE)
set(prefix ${BUILD_DIR}/consumer/prefix)
file(REMOVE_RECURSE ${prefix})
foreach(command
    "${CMAKE_COMMAND} --install ${BUILD_DIR} --component development --prefix ${prefix}"
    "${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${BUILD_DIR}/consumer/build -G Ninja -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Debug -DNEW_REPRESENTATION_DIR=${example}"
    "${CMAKE_COMMAND} --build ${BUILD_DIR}/consumer/build"
    "${BUILD_DIR}/consumer/build/consumer"
    "${BUILD_DIR}/consumer/build/new_representation/check_sh6")
  separate_arguments(words UNIX_COMMAND "${command}")
  execute_process(COMMAND ${words} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
