# cmake -DOUTPUT=shader_texts.cpp -DFOLDER=resources/shaders -P embed_shaders.cmake
# Writes a C++ file that holds the texts of the shaders.
file(READ "${FOLDER}/planes.vert" vertex)
file(READ "${FOLDER}/planes.frag" fragment)
file(WRITE "${OUTPUT}" "#include \"viewer/render/gl/shader_texts.h\"

namespace volumen {

const char* const planesVertexShader = R\"volumen(${vertex})volumen\";
const char* const planesFragmentShader = R\"volumen(${fragment})volumen\";

}  // namespace volumen
")
