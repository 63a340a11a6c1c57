# FFTW in double and single precision, with the libraries that make its planner safe for threads:
# the target rholm_fftw3, a list of libraries without more.
find_path(FFTW3_INCLUDE_DIR fftw3.h)
set(FFTW3_LIBRARIES "")
foreach(name fftw3_threads fftw3f_threads fftw3 fftw3f)
  find_library(FFTW3_${name}_LIBRARY ${name})
  list(APPEND FFTW3_LIBRARIES ${FFTW3_${name}_LIBRARY})
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FFTW3 REQUIRED_VARS FFTW3_INCLUDE_DIR
  FFTW3_fftw3_threads_LIBRARY FFTW3_fftw3f_threads_LIBRARY FFTW3_fftw3_LIBRARY
  FFTW3_fftw3f_LIBRARY)
if(FFTW3_FOUND AND NOT TARGET FFTW3::fftw3)
  add_library(FFTW3::fftw3 INTERFACE IMPORTED)
  set_target_properties(FFTW3::fftw3 PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${FFTW3_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${FFTW3_LIBRARIES}")
endif()
