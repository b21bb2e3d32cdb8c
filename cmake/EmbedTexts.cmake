# gnomon_embed_texts(TARGET NAMESPACE HEADER file...): each file becomes `NAMESPACE::<name_ext>`, a string constant in HEADER.
function(gnomon_embed_texts target namespace header)
  set(text "// Made by CMake from the files themselves.\n#pragma once\nnamespace ${namespace} {\n")
  foreach(file ${ARGN})
    get_filename_component(file ${file} ABSOLUTE) # one name a file, or Ninja takes it for two
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} content)
    get_filename_component(name ${file} NAME)
    string(MAKE_C_IDENTIFIER ${name} name)
    string(APPEND text "inline constexpr const char* ${name} = R\"embedded(${content})embedded\";\n")
  endforeach()
  string(APPEND text "} // namespace ${namespace}\n")
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated)
  file(CONFIGURE OUTPUT ${folder}/${header} CONTENT "@text@" @ONLY) # touches it only if it changes
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
