# cmake -DOUTPUT=preset_texts.cpp -DFUNCTION=presetTexts -DHEADER=viewer/scene/preset_texts.h "-DFILES=a.json;b.json" -P embed_texts.cmake
# Writes a C++ file with a function that returns the text of each file, in the order given.
set(texts "")
foreach(file IN LISTS FILES)
  file(READ "${file}" text)
  string(APPEND texts "    R\"volumen(${text})volumen\",\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"${HEADER}\"

namespace volumen {

const std::vector<std::string>& ${FUNCTION}() {
  static const std::vector<std::string> texts{
${texts}  };
  return texts;
}

}  // namespace volumen
")
