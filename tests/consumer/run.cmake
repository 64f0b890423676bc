# Installs the development files to a fresh prefix, then configures, builds and runs the outside project against it.
set(prefix ${BUILD_DIR}/consumer/prefix)
file(REMOVE_RECURSE ${prefix})
foreach(command
    "${CMAKE_COMMAND} --install ${BUILD_DIR} --component development --prefix ${prefix}"
    "${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${BUILD_DIR}/consumer/build -G Ninja -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Debug"
    "${CMAKE_COMMAND} --build ${BUILD_DIR}/consumer/build"
    "${BUILD_DIR}/consumer/build/consumer")
  separate_arguments(words UNIX_COMMAND "${command}")
  execute_process(COMMAND ${words} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
