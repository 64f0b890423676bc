# octafield_module(NAME): the static library octafield_NAME (alias octafield::NAME) of the sources in NAME/src/, with the
# project's warnings. Each module links its dependencies itself: PUBLIC what its headers need, PRIVATE solvers and file libraries.
add_library(octafield_warnings INTERFACE)
target_compile_options(octafield_warnings INTERFACE -Wall -Wextra $<$<BOOL:${OCTAFIELD_WERROR}>:-Werror>)
if(OCTAFIELD_SANITIZE)
  # With these, GCC takes values of CGAL's headers for uninitialized that are not (it says so of itself).
  target_compile_options(octafield_warnings INTERFACE -fsanitize=${OCTAFIELD_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined
                         -Wno-maybe-uninitialized)
  add_link_options(-fsanitize=${OCTAFIELD_SANITIZE})
endif()

# octafield_headers(NAME HEADERS ... LINKS ... [OPTIONS ...]): system headers that the sources of several targets include, parsed once for
# all of them. Headers of this project stay out, so that an edit compiles what includes it and no more. LINKS and OPTIONS: what
# changes how the compiler reads them; targets that differ in it read the headers anew.
function(octafield_headers name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINKS;OPTIONS" ${ARGN})
  if(NOT OCTAFIELD_PCH)
    return()
  endif()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/octafield_headers_${name}.cpp)
  file(GENERATE OUTPUT ${source} CONTENT "")
  add_library(octafield_headers_${name} OBJECT EXCLUDE_FROM_ALL ${source})
  target_link_libraries(octafield_headers_${name} PRIVATE octafield_warnings Threads::Threads ${ARG_LINKS})
  target_compile_options(octafield_headers_${name} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(octafield_headers_${name} PRIVATE ${ARG_HEADERS})
endfunction()

# octafield_use_headers(TARGET NAME): the target's sources read the headers of octafield_headers(NAME ...) as precompiled there.
function(octafield_use_headers target name)
  if(OCTAFIELD_PCH)
    target_precompile_headers(${target} REUSE_FROM octafield_headers_${name})
  endif()
endfunction()

# octafield_join_sources(TARGET): eight of the target's sources at a time are compiled as one, so that headers and templates are
# read once for them: half to three quarters of the time of a clean build, more of one after an edit. Names in unnamed
# namespaces differ for that.
function(octafield_join_sources target)
  if(OCTAFIELD_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
endfunction()

# The folder's static library TARGET, exported as octafield::NAME, with what its headers need of system headers. A new source is
# found at the next build.
function(octafield_library target name)
  file(GLOB sources CONFIGURE_DEPENDS src/*.cpp)
  add_library(${target} STATIC ${sources})
  add_library(octafield::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:octafield_warnings>)
  install(TARGETS ${target} EXPORT octafield COMPONENT development ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/include)
    install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
  endif()
endfunction()

function(octafield_module name)
  octafield_library(octafield_${name} ${name})
endfunction()

# octafield_submodule(MODULE NAME USES ...): the static library octafield_MODULE_NAME of the folder MODULE/NAME/.
# USES: the sub-modules of the same module below it. Their headers in include/ and their private ones in src/ can be included, those of
# no other: so the compiler and the linker check the directions.
function(octafield_submodule module name)
  cmake_parse_arguments(ARG "" "" "USES" ${ARGN})
  set(target octafield_${module}_${name})
  octafield_library(${target} ${module}_${name})
  add_library(${target}_parts INTERFACE)  # the private headers, for its neighbours and tests
  target_include_directories(${target}_parts INTERFACE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  foreach(used ${ARG_USES})
    target_link_libraries(${target} PUBLIC octafield_${module}_${used} PRIVATE $<BUILD_INTERFACE:octafield_${module}_${used}_parts>)
  endforeach()
endfunction()

# octafield_submodules(MODULE NAMES...): adds the folders and makes octafield::MODULE, which is all of them.
function(octafield_submodules module)
  add_library(octafield_${module} INTERFACE)
  add_library(octafield::${module} ALIAS octafield_${module})
  set_target_properties(octafield_${module} PROPERTIES EXPORT_NAME ${module})
  add_library(octafield_${module}_parts INTERFACE)
  foreach(name ${ARGN})
    add_subdirectory(${name})
    target_link_libraries(octafield_${module} INTERFACE octafield_${module}_${name})
    target_link_libraries(octafield_${module}_parts INTERFACE octafield_${module}_${name}_parts)
  endforeach()
  install(TARGETS octafield_${module} EXPORT octafield COMPONENT development)
endfunction()
