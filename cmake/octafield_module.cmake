# octafield_module(NAME SOURCES ...): the static library octafield_NAME (alias octafield::NAME) of the folder NAME/, with the
# project's warnings. Each module links its dependencies itself: PUBLIC what its headers need, PRIVATE solvers and file libraries.
add_library(octafield_warnings INTERFACE)
target_compile_options(octafield_warnings INTERFACE -Wall -Wextra $<$<BOOL:${OCTAFIELD_WERROR}>:-Werror>)
if(OCTAFIELD_SANITIZE)
  target_compile_options(octafield_warnings INTERFACE -fsanitize=${OCTAFIELD_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  add_link_options(-fsanitize=${OCTAFIELD_SANITIZE})
endif()

# octafield_precompile(TARGET HEADERS...): system headers that most of the target's sources include, parsed once. Headers of this
# project stay out, so that an edit compiles what includes it and no more.
function(octafield_precompile target)
  if(OCTAFIELD_PCH)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

function(octafield_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES" ${ARGN})
  set(target octafield_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(octafield::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:octafield_warnings>)
  install(TARGETS ${target} EXPORT octafield COMPONENT development ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
endfunction()
