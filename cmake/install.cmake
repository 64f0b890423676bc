# Package configuration, so that another CMake project can find_package(octafield). Component "development".
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/octafield)
configure_package_config_file(cmake/octafieldConfig.cmake.in octafieldConfig.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(octafieldConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/octafieldConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/octafieldConfigVersion.cmake
  DESTINATION ${config_dir} COMPONENT development)
install(EXPORT octafield NAMESPACE octafield:: DESTINATION ${config_dir} COMPONENT development)
