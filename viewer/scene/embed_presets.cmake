# cmake -DOUTPUT=preset_texts.cpp "-DPRESETS=a.json;b.json" -P embed_presets.cmake
# Writes a C++ file that holds the text of each preset, in the order given.
set(texts "")
foreach(preset IN LISTS PRESETS)
  file(READ "${preset}" text)
  string(APPEND texts "    R\"volumen(${text})volumen\",\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"viewer/scene/preset_texts.h\"

namespace volumen {

const std::vector<std::string>& presetTexts() {
  static const std::vector<std::string> texts{
${texts}  };
  return texts;
}

}  // namespace volumen
")
