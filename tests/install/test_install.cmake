# Installs into a scratch prefix, builds a consumer against it, and runs that and the program.
#   cmake -DBUILD=<build folder> -DSOURCE=<source folder> -DSCRATCH=<folder> -P test_install.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${code}:\n${out}")
  endif()
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/install/consumer -B ${SCRATCH}/build
    -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix
    -DEXAMPLE=${SOURCE}/examples/best_view.cpp)
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
run(${SCRATCH}/build/consumer ${SOURCE}/models/fan.ply ${SCRATCH}/fan.png)
run(${SCRATCH}/prefix/bin/vantage info ${SOURCE}/models/fan.ply)
if(NOT EXISTS ${SCRATCH}/fan.png)
  message(FATAL_ERROR "the consumer wrote no picture")
endif()

# The same by pkg-config, and what shells and readers of manuals look for.
set(ENV{PKG_CONFIG_PATH} ${SCRATCH}/prefix/${LIBDIR}/pkgconfig)
find_program(PKG_CONFIG NAMES pkg-config pkgconf)
if(PKG_CONFIG)
  execute_process(COMMAND ${PKG_CONFIG} --cflags --libs vantage OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^ ]+" flags "${flags}")
  run(c++ ${SOURCE}/examples/best_view.cpp ${flags} -o ${SCRATCH}/by_pkg_config)
  run(${SCRATCH}/by_pkg_config ${SOURCE}/models/fan.ply ${SCRATCH}/again.png)
  run(${CMAKE_COMMAND} -E compare_files ${SCRATCH}/fan.png ${SCRATCH}/again.png)

  # The program that the README shows, word for word.
  file(READ ${SOURCE}/README.md readme)
  string(REGEX MATCH "```cpp\n([^`]*)```" block "${readme}")
  file(WRITE ${SCRATCH}/readme.cpp "${CMAKE_MATCH_1}")
  file(COPY_FILE ${SOURCE}/models/fan.ply ${SCRATCH}/horse.ply)
  run(c++ ${SCRATCH}/readme.cpp ${flags} -o ${SCRATCH}/readme)
  run(${CMAKE_COMMAND} -E chdir ${SCRATCH} ${SCRATCH}/readme)
  if(NOT EXISTS ${SCRATCH}/best.png)
    message(FATAL_ERROR "the program of the README wrote no picture")
  endif()
else()
  message("pkg-config is not installed: vantage.pc is not tested")
endif()
foreach(file IN ITEMS man/man1/vantage.1.gz man/man1/vantage-view.1.gz bash-completion/completions/vantage
        zsh/vendor-completions/_vantage fish/vendor_completions.d/vantage.fish doc/vantage/copyright doc/vantage/NOTICES)
  if(NOT EXISTS ${SCRATCH}/prefix/share/${file})
    message(FATAL_ERROR "share/${file} is not installed")
  endif()
endforeach()

# What reads CAD and game formats is a package of its own.
file(GLOB_RECURSE extra ${SCRATCH}/prefix/*vantage-import*)
if(extra)
  message(FATAL_ERROR "the default install has ${extra}")
endif()
if(EXISTS ${BUILD}/apps/vantage/vantage-import)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix --component import)
  run(${SCRATCH}/prefix/bin/vantage info ${SOURCE}/tests/data/import/stand.step)
  run(${SCRATCH}/prefix/bin/vantage thumb ${SOURCE}/tests/data/import/stand.step ${SCRATCH}/stand.png)
endif()

# The thumbnailer's own command line, as a file manager fills it in.
file(STRINGS ${SCRATCH}/prefix/share/thumbnailers/vantage.thumbnailer exec REGEX "^Exec=")
string(REGEX REPLACE "^Exec=vantage " "" exec "${exec}")
string(REPLACE "%i" "${SOURCE}/models/fan.ply" exec "${exec}")
string(REPLACE "%o" "${SCRATCH}/thumbnail.XYZ123" exec "${exec}")
string(REPLACE "%s" "128" exec "${exec}")
separate_arguments(exec UNIX_COMMAND "${exec}")
run(${SCRATCH}/prefix/bin/vantage ${exec})
file(READ ${SCRATCH}/thumbnail.XYZ123 head LIMIT 24 HEX)
if(NOT head MATCHES "^89504e47.*0000008000000080$")
  message(FATAL_ERROR "the thumbnailer wrote no PNG of 128 × 128: ${head}")
endif()
if(NOT EXISTS ${SCRATCH}/prefix/share/mime/packages/vantage.xml)
  message(FATAL_ERROR "the types of PLY and OFF are not installed")
endif()
