# Tests mutate.cmake: a good mutation changes one place; a bad one fails and says why.
#   cmake -D SCRATCH=folder -P mutate_test.cmake

cmake_minimum_required(VERSION 3.25)

set(script "${CMAKE_CURRENT_LIST_DIR}/mutate.cmake")
file(REMOVE_RECURSE "${SCRATCH}")
file(WRITE "${SCRATCH}/formula.h" "a[0] = b[1];\nif (c || d) e();\nf();\nf();\n")
file(WRITE "${SCRATCH}/list.txt" "# comment
good | formula.h | a[0] = b[1]; | a[1] = b[0];
condition | formula.h | c || d | c && d
absent | formula.h | g(); | h();
twice | formula.h | f(); | h();
short | formula.h
")

# mutate(NAME EXPECTED): EXPECTED is the text of the mutated file, or a part of the error message.
function(mutate name expected)
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -D LIST=${SCRATCH}/list.txt -D SOURCE_DIR=${SCRATCH} -D NAME=${name}
            -D OUTPUT=${SCRATCH}/${name}.h -P "${script}"
    RESULT_VARIABLE status ERROR_VARIABLE message)
  if(status EQUAL 0)
    file(READ "${SCRATCH}/${name}.h" result)
  else()
    string(REGEX REPLACE "[ \n]+" " " result "${message}")
  endif()
  string(FIND "${result}" "${expected}" position)
  if(position LESS 0)
    message(FATAL_ERROR "${name}: expected\n${expected}\ngot\n${result}")
  endif()
  if(NOT status EQUAL 0 AND EXISTS "${SCRATCH}/${name}.h")
    message(FATAL_ERROR "${name}: failed, but wrote a file")
  endif()
endfunction()

mutate(good "a[1] = b[0];\nif (c || d) e();\nf();\nf();\n")
mutate(condition "a[0] = b[1];\nif (c && d) e();\nf();\nf();\n")
mutate(absent "absent: formula.h does not contain")
mutate(twice "twice: formula.h contains \"f();\" more than once")
mutate(short "short: a mutation has four fields")
mutate(unknown "no mutation is called unknown")
