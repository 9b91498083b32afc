# Writes -D output=<source>: the files -D files=<paths, separated by commas> as texts by name, what
# -D function=<name> in -D namespace=<name> returns; -D header=<path> declares it.
cmake_minimum_required(VERSION 3.25)
set(text "#include \"${header}\"\n\nnamespace ${namespace} {\n\n")
string(APPEND text "const std::map<std::string, std::string>& ${function}() {\n")
string(REPLACE "," ";" files "${files}")
string(APPEND text "  static const std::map<std::string, std::string> kFiles{\n")
foreach(file IN LISTS files)
  file(READ "${file}" content)
  cmake_path(GET file FILENAME name)
  string(APPEND text "{\"${name}\", R\"page(${content})page\"},\n")
endforeach()
string(APPEND text "  };\n  return kFiles;\n}\n\n}  // namespace ${namespace}\n")
file(WRITE "${output}" "${text}")
