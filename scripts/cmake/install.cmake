# What is installed, as two components: the program with its data, and the libraries for programs of others (development).
include(CMakePackageConfigHelpers)
set(include_folder ${CMAKE_INSTALL_INCLUDEDIR})
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/snug)
set(data_folder ${CMAKE_INSTALL_DATADIR}/snug)

install(TARGETS snug RUNTIME COMPONENT program)
install(DIRECTORY cases/ DESTINATION ${data_folder}/cases COMPONENT program
        REGEX "/cases/input$" EXCLUDE PATTERN "out" EXCLUDE PATTERN "out.*" EXCLUDE PATTERN "study" EXCLUDE)
install(DIRECTORY mesh/data/bodies/ DESTINATION ${data_folder}/bodies COMPONENT program)
install(FILES scripts/picture.py scripts/film.py DESTINATION ${data_folder}/scripts COMPONENT program)
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
# The manual and the completions of shells come from the program itself, when it is installed.
set(manual_folder ${PROJECT_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${manual_folder})
install(CODE "foreach(page \"man;snug.1\" \"completion bash;snug\" \"completion zsh;_snug\" \"completion fish;snug.fish\")
  list(GET page 0 words)
  list(GET page 1 name)
  separate_arguments(words)
  execute_process(COMMAND \"$<TARGET_FILE:snug>\" \${words} OUTPUT_FILE \"${manual_folder}/\${name}\" COMMAND_ERROR_IS_FATAL ANY)
endforeach()" COMPONENT program)
install(FILES ${manual_folder}/snug.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${manual_folder}/snug DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${manual_folder}/_snug DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES ${manual_folder}/snug.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# <snug/snug.hpp> and the headers that it reaches, with their paths, below include/snug. That folder is in the path of the
# compiler, too, since the headers include each other from there.
configure_file(solver/library/snug.hpp.in ${PROJECT_BINARY_DIR}/include/snug/snug.hpp @ONLY)
set(rooms snug_input snug_fem snug_mesh snug_materials snug_postproc snug_solver)
foreach(room IN LISTS rooms)
  target_include_directories(${room} PUBLIC $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
  if(SNUG_EIGEN_ALIGNMENT GREATER 16)  # libgmsh must not find this Eigen in a program of others, either
    target_compile_options(${room} INTERFACE
      $<INSTALL_INTERFACE:$<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-fvisibility=hidden>>)
    target_link_options(${room} INTERFACE $<INSTALL_INTERFACE:LINKER:--exclude-libs,ALL>)
  endif()
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/include/snug/snug.hpp DESTINATION ${include_folder}/snug COMPONENT development)
install(CODE "set(source \"${PROJECT_SOURCE_DIR}\")
set(first \"${PROJECT_BINARY_DIR}/include/snug/snug.hpp\")
set(folder \"\${CMAKE_INSTALL_PREFIX}/${include_folder}/snug\")" COMPONENT development)
install(SCRIPT scripts/cmake/public_headers.cmake COMPONENT development)

install(TARGETS ${rooms} EXPORT snugTargets ARCHIVE COMPONENT development
        INCLUDES DESTINATION ${include_folder} ${include_folder}/snug)
install(EXPORT snugTargets NAMESPACE snug:: DESTINATION ${package_folder} COMPONENT development)
get_property(linked_by_name GLOBAL PROPERTY SNUG_LINKED_BY_NAME)
list(REMOVE_DUPLICATES linked_by_name)
configure_package_config_file(scripts/cmake/snugConfig.cmake.in ${PROJECT_BINARY_DIR}/snugConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/snugConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/snugConfig.cmake ${PROJECT_BINARY_DIR}/snugConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT development)

# cpack -G DEB (scripts/package): one package a component.
set(CPACK_PACKAGE_CONTACT "the authors of snug")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The authors of snug <snug@localhost>")
set(CPACK_PACKAGE_VENDOR "snug")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME snug)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "pressure and comfort of a garment on a body by finite elements
 snug meshes a body and a garment, solves their contact with finite elements
 and writes ParaView files, tables, pressures by location, a comfort score and
 a report. A case is a folder with one text file; examples are in
 /usr/share/snug/cases.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
# The other BLAS solves four times slower; the rest are programs that some commands run: ranks, pictures and films, plots.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libopenblas0-pthread")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "openmpi-bin, python3-vtk9, xvfb, xauth, ffmpeg, gnuplot-nox")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsnug-dev)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "libraries of snug for programs of others
 Headers, static libraries and the CMake package (find_package(snug),
 snug::solver) of snug.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libdeal.ii-dev, libmumps-dev, libmetis-dev, libgmsh-dev, libvtk9-dev, libeigen3-dev, libgsl-dev, libfuzzylite-dev, libudunits2-dev, libsqlite3-dev, libfmt-dev, libdxflib-dev, libpugixml-dev, libzip-dev, libgmp-dev, libmpfr-dev")

include(CPack)
