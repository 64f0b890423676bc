# cmake -DNM=nm -DLIBRARY=module.so -P require_defined.cmake: fails where a function of this project is used that nobody defines, such
# as a template that was instantiated nowhere. -z defs cannot be given for a Python module, whose Python functions are the interpreter's.
execute_process(COMMAND ${NM} --dynamic --undefined-only --demangle ${LIBRARY} OUTPUT_VARIABLE symbols RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${NM} cannot read ${LIBRARY}")
endif()
string(REGEX MATCHALL "[^\n]* octafield::[^\n]*" missing "${symbols}")
if(missing)
  list(JOIN missing "\n" missing)
  file(REMOVE ${LIBRARY})
  message(FATAL_ERROR "undefined functions in ${LIBRARY}:\n${missing}")
endif()
