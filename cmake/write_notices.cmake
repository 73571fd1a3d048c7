# Writes the licences of what is compiled into the program, word for word, as those licences ask:
#   cmake -DOUTPUT=<file> -DTHREE=<licence of three.js, or nothing> -P write_notices.cmake
# The header-only libraries' are where Debian puts them; elsewhere THIRD_PARTY.md names them and that is said.
set(text "Vantage contains parts of the libraries below. THIRD_PARTY.md says what for.\n")
foreach(package IN ITEMS libeigen3-dev libnanoflann-dev nlohmann-json3-dev libtinygltf-dev libcli11-dev libcpp-httplib-dev)
  set(licence /usr/share/doc/${package}/copyright)
  string(APPEND text "\n==== ${package}\n\n")
  if(EXISTS ${licence})
    file(READ ${licence} words)
    string(APPEND text "${words}")
  else()
    string(APPEND text "This build found no ${licence}; see the library's own distribution.\n")
  endif()
endforeach()
if(EXISTS "${THREE}")
  file(READ "${THREE}" words)
  string(APPEND text "\n==== three.js, in report.html\n\n${words}")
endif()
file(WRITE ${OUTPUT} "${text}")
