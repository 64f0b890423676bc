# Ceres, without the ATLAS that Debian's package names: its symbols would hide those of the BLAS the system has chosen (OpenBLAS).
set(BLA_VENDOR Generic)  # FindBLAS takes ATLAS first otherwise
find_package(Ceres REQUIRED)
get_target_property(ceres_libraries Ceres::ceres INTERFACE_LINK_LIBRARIES)
list(FILTER ceres_libraries EXCLUDE REGEX "f77blas|atlas")
set_target_properties(Ceres::ceres PROPERTIES INTERFACE_LINK_LIBRARIES "${ceres_libraries}")
