# With VANTAGE_PRECOMPILE: what most sources include is parsed once a target instead of once a source.
# Off by default, because a source that forgets an include would compile.
set(VANTAGE_SHARED_HEADERS <algorithm> <array> <cmath> <cstdint> <limits> <map> <memory> <numbers> <numeric> <optional>
    <span> <string> <string_view> <tuple> <utility> <vector> <Eigen/Geometry>)

# vantage_precompile(<target> more headers…)
function(vantage_precompile target)
  if(VANTAGE_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${VANTAGE_SHARED_HEADERS} ${ARGN})
  endif()
endfunction()
