# With VANTAGE_QUICK_BUILD, as in the preset release, for builds from nothing: what most sources include is parsed once a
# target instead of once a source, and the sources of a folder are compiled as one. Off elsewhere, because a source that
# forgets an include would compile, and because a change of one source compiles its neighbours again.
set(VANTAGE_SHARED_HEADERS <algorithm> <array> <cmath> <cstdint> <limits> <map> <memory> <numbers> <numeric> <optional>
    <span> <string> <string_view> <tuple> <utility> <vector> <Eigen/Geometry>)

# There are sixty programs to link, each in half the time by GNU's gold. It warns of a symbol of the sanitizers.
if(VANTAGE_QUICK_BUILD AND NOT VANTAGE_SANITIZE)
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=gold VANTAGE_LINKS_BY_GOLD)
  if(VANTAGE_LINKS_BY_GOLD)
    add_link_options(-fuse-ld=gold)
  endif()
endif()

# vantage_precompile(<target> more headers…)
function(vantage_precompile target)
  if(VANTAGE_QUICK_BUILD)
    target_precompile_headers(${target} PRIVATE ${VANTAGE_SHARED_HEADERS} ${ARGN})
  endif()
endfunction()

# More sources of a folder are compiled in even parts of at most so many: where one job takes a fifth of the build, cores
# wait for it.
set(VANTAGE_SOURCES_AS_ONE 46)

# vantage_unite(<target> sources that are compiled alone…): call it when the target has all its sources. Sources clash if
# both give a name of their own, in an unnamed namespace, another meaning: rename one, or list it.
function(vantage_unite target)
  if(NOT VANTAGE_QUICK_BUILD)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(name ${source} NAME)
    get_filename_component(folder ${source} DIRECTORY)
    get_filename_component(folder "${folder}" NAME)
    if(NOT name IN_LIST ARGN)
      list(APPEND folders "${folder}_")
      list(APPEND of_${folder}_ ${source})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    list(LENGTH of_${folder} count)
    math(EXPR parts "(${count} + ${VANTAGE_SOURCES_AS_ONE} - 1) / ${VANTAGE_SOURCES_AS_ONE}")
    set(k 0)
    foreach(source IN LISTS of_${folder})
      math(EXPR part "${k} * ${parts} / ${count}")
      math(EXPR k "${k} + 1")
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP "${folder}${part}")
    endforeach()
  endforeach()
endfunction()
