# cmake -DOUTPUT=shader_texts.cpp -DFOLDER=resources/shaders "-DFILES=a.frag;b.glsl" -P embed_shaders.cmake
# Writes a C++ file that holds the texts of the shaders: of a.frag as shaders::a_frag.
file(WRITE "${OUTPUT}" "#include \"viewer/gl/shader_texts.h\"\n\nnamespace volumen::shaders {\n\n")
foreach(file IN LISTS FILES)
  file(READ "${FOLDER}/${file}" text)
  string(REPLACE "." "_" name "${file}")
  file(APPEND "${OUTPUT}" "const char* const ${name} = R\"volumen(${text})volumen\";\n")
endforeach()
file(APPEND "${OUTPUT}" "\n}  // namespace volumen::shaders\n")
