# Runs at build time: writes OUTPUT with the commit of the sources, and leaves it alone when nothing has changed.
set(commit "unknown")
find_program(git_program git)
if(git_program)
  execute_process(COMMAND ${git_program} describe --always --dirty --abbrev=12
    WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit "${described}")
  endif()
endif()
set(text "#include \"core/version.hpp\"

namespace pliant {

BuildInfo build_info() { return {\"${VERSION}\", \"${commit}\", \"${COMPILER}\", \"${FLAGS}\"}; }

}  // namespace pliant
")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
