# What systems call the library with the grids, which is opened by this name; and how a linker is told to refuse names that
# nothing defines and to bind a library's own, as those of macOS and Windows do by themselves.
if(APPLE)
  set(grid_library libespalier.${soversion}.dylib)
elseif(WIN32)
  set(grid_library libespalier.dll)
else()
  set(grid_library libespalier.so.${soversion})
  if(NOT ESPALIER_FUZZ)
    set(nothing_undefined LINKER:-z,defs)
  endif()
  # Calls within a library go straight to what it defines, and not through its table of names, which others could fill.
  target_compile_options(espalier_options INTERFACE -fno-semantic-interposition)
  target_link_options(espalier_options INTERFACE LINKER:-Bsymbolic-functions)
endif()
