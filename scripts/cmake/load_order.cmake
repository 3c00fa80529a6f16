# The order in which the dynamic linker searches the program's libraries. deal.II and gmsh bring some two hundred along, and each of
# 350,000 symbols that are bound before main is looked up in one after the other, in the order of the program's list. With those
# first that most symbols are bound to (LD_DEBUG=bindings tells them) every run and rank starts sooner.
# Nothing is loaded that is not loaded anyway: what deal.II does not bring along is left out.
set(SNUG_MOST_BOUND libdeal.ii libgmsh libTKSTEPBase libtrilinos_teuchosparameterlist libTKIGES libTKTopAlgo libTKSTEP libstdc++ libTKXSBase
    libTKMath libTKGeomAlgo libTKernel libTKGeomBase libTKSTEPAttr libalglib libTKV3d libTKBO libTKG3d libc libTKBool libTKBRep libpetsc_real
    libtrilinos_ml libtrilinos_epetra libtrilinos_ifpack libmpi libTKShHealing libTKLCAF libTKMesh libTKFillet libtrilinos_teuchoscomm
    libTKXCAF libTKG2d libtrilinos_epetraext)

# Puts them first in the list of `program`.
function(snug_load_order program)
  find_library(SNUG_DEAL_II NAMES deal.ii deal_II)
  execute_process(COMMAND ldd ${SNUG_DEAL_II} OUTPUT_VARIABLE brought_along ERROR_QUIET)
  set(first ${SNUG_DEAL_II})
  foreach(name IN LISTS SNUG_MOST_BOUND)
    string(REPLACE "+" "\\+" pattern ${name})
    if(brought_along MATCHES "=> ([^ \n]*/${pattern}\\.so[^ \n]*) ")
      list(APPEND first ${CMAKE_MATCH_1})
    endif()
  endforeach()
  list(JOIN first " " first)
  target_link_options(${program} PRIVATE "SHELL:-Wl,--push-state,--no-as-needed ${first} -Wl,--pop-state")
endfunction()
