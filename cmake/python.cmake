# Decides whether the Python package is built: by default where its tests are and what it needs is
# there. Debian's interpreter comes first, because python3-numpy is a package of that one.
find_program(VANTAGE_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(VANTAGE_PYTHON python3)
set(PYBIND11_FINDPYTHON ON)
set(Python_EXECUTABLE ${VANTAGE_PYTHON})
if(NOT DEFINED VANTAGE_BUILD_PYTHON)
  # The interpreter itself is not built with a sanitizer's runtime.
  if(NOT VANTAGE_BUILD_TESTS OR VANTAGE_SANITIZE)
    return()
  endif()
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 CONFIG QUIET)
  if(NOT Python_FOUND OR NOT pybind11_FOUND) # looked for again next time
    message(STATUS "pybind11 or Python's headers not found: the Python package is neither built nor tested")
    return()
  endif()
endif()
option(VANTAGE_BUILD_PYTHON "Build the Python package (needs pybind11-dev, python3-dev)" ON)
if(VANTAGE_BUILD_PYTHON)
  find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 CONFIG REQUIRED) # Python bindings (BSD-3)
  add_subdirectory(python)
endif()
