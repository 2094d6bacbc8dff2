# cmake -DOUTPUT=revision.cpp -P write_revision.cmake
# Writes a C++ file with the revision that git names here ("-dirty": with changes since), "unknown" without git. A file that says the same stays.
execute_process(COMMAND git -c safe.directory=* describe --always --dirty --exclude=* --abbrev=12 WORKING_DIRECTORY ${CMAKE_CURRENT_LIST_DIR}
  OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(revision unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#include \"app/version.h\"

namespace volumen {

const char* const revision = \"${revision}\";

}  // namespace volumen
")
