# Flags every target of the project shares; never exported to users of the library.
add_library(vantage_options INTERFACE)
target_compile_options(vantage_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion
  -ffp-contract=off                       # a fused multiply-add would make bytes depend on the machine
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> # false alarm of gcc 12 at -O3 (GCC bug 105329)
  # Quick builds: the same about strings put together; and in a united source the main file is not that of the class.
  "$<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${VANTAGE_QUICK_BUILD}>>:-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-array-bounds;-Wno-subobject-linkage>"
  # … and clang takes names of another source for shadowed.
  "$<$<AND:$<CXX_COMPILER_ID:Clang>,$<BOOL:${VANTAGE_QUICK_BUILD}>>:-Wno-shadow>"
  $<$<BOOL:${VANTAGE_WERROR}>:-Werror>)
target_compile_definitions(vantage_options INTERFACE EIGEN_DONT_PARALLELIZE EIGEN_MPL2_ONLY)

if(VANTAGE_SANITIZE)
  add_compile_options(-fsanitize=${VANTAGE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  if(VANTAGE_SANITIZE MATCHES "address")
    # Null pointers end in the address sanitizer's report all the same; these checks take a fifth of the compiler's time.
    add_compile_options(-fno-sanitize=null,vptr,object-size)
    if(VANTAGE_QUICK_BUILD)
      # A third of the compiler's time; scripts/check_all.sh runs all tests with this check.
      add_compile_options(-fno-sanitize=alignment)
    endif()
  endif()
  add_link_options(-fsanitize=${VANTAGE_SANITIZE})
endif()
