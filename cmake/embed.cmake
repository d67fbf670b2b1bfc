# repose_embed(TARGET NAMESPACE FILE...) puts files into a library or program:
#
#   repose_embed(repose_calibrate repose::calibrate::templates templates/deck.tpl templates/page.css)
#
# defines there, to be declared in a header of the module,
#
#   namespace repose::calibrate::templates {
#   std::string_view embedded_file(std::string_view name);
#   }
#
# which returns a file's bytes by its name as written above, relative to the folder of the
# CMakeLists.txt (for an absolute path, such as a generated file's, by its last part), and throws
# std::out_of_range for an unknown name. The bytes stay valid until the program ends and are followed by
# a NUL. The next build includes a changed file.
#
# The assembler includes the bytes: arrays of megabytes are slow to compile in C++.
#
# This file is also the script that writes the source during the build:
#   cmake -D OUTPUT=FILE.cpp -D NAMESPACE=N -D FOLDER=F "-DNAMES=a|b" -P embed.cmake

function(repose_embed target namespace)
  string(REPLACE "::" "_" stem ${namespace})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded/${stem}.cpp)
  list(JOIN ARGN "|" names)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE files)
  list(TRANSFORM files REPLACE "^.+//" "/")  # absolute paths as given
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D OUTPUT=${output} -D NAMESPACE=${namespace}
      -D FOLDER=${CMAKE_CURRENT_SOURCE_DIR} "-DNAMES=${names}"
      -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    DEPENDS ${files} ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    COMMENT "Embedding files as ${namespace}"
    VERBATIM)
  # In its own target: files generated for a library wait for all libraries that it links.
  add_library(${stem} OBJECT ${output})
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:${stem}>)
endfunction()

function(repose_write_embedded)
  string(REPLACE "|" ";" names "${NAMES}")
  string(REPLACE "::" "_" stem ${NAMESPACE})
  set(symbols "")
  set(entries "")
  set(number 0)
  foreach(name IN LISTS names)
    set(symbol ${stem}_${number})
    # The hash makes a changed file change this source: compiler caches do not look into .incbin.
    set(file ${FOLDER}/${name})
    if(IS_ABSOLUTE ${name})
      set(file ${name})
      get_filename_component(name ${name} NAME)
    endif()
    file(SHA256 ${file} hash)
    file(SIZE ${file} size)
    string(APPEND symbols "// ${hash}
__asm__(\".pushsection .rodata\\n\"
        \"${symbol}: .incbin \\\"${file}\\\"\\n\"
        \".byte 0\\n\"
        \".global ${symbol}\\n\"
        \".popsection\\n\");
extern \"C\" const char ${symbol}[];
")
    string(APPEND entries "  if (name == \"${name}\") return {${symbol}, ${size}};\n")
    math(EXPR number "${number} + 1")
  endforeach()
  file(WRITE ${OUTPUT} "// Written by cmake/embed.cmake.
#include <stdexcept>
#include <string>
#include <string_view>

${symbols}
namespace ${NAMESPACE} {

std::string_view embedded_file(std::string_view name);

std::string_view embedded_file(std::string_view name) {
${entries}  throw std::out_of_range(\"no embedded file is called \" + std::string(name));
}

}  // namespace ${NAMESPACE}
")
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  repose_write_embedded()
endif()
