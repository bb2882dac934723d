function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(result)
    message(FATAL_ERROR "${ARGV}\n${output}")
  endif()
  set(said "${output}" PARENT_SCOPE)
endfunction()
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
set(flags)
if(FLAGS)
  set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${FLAGS})
endif()
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_COMPILER=${COMPILER} ${flags})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/mixture_test)

# The explorer half: what the explorer itself says of it.
find_program(probe emca-plugin-probe PATHS ${WORK}/prefix/bin ${WORK}/prefix/libexec/emca ${WORK}/prefix/lib/emca NO_DEFAULT_PATH)
if(probe)
  run(${CMAKE_COMMAND} -E env QT_QPA_PLATFORM=offscreen ${probe} ${WORK}/build/spherical-mixture.so)
endif()

# The server half, in the renderer: a light above the middle of a closed box makes a lobe that points to it.
file(WRITE ${WORK}/ask.sh [[
set -e
"$1/prefix/bin/emca-render" "$1/prefix/share/emca/scenes/cornell-box/scene.xml" --serve 0 --tool "$1/build/spherical-mixture-server.so" > "$1/address" &
server=$!
trap 'kill $server' EXIT
for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
  grep -q listening "$1/address" && break
  sleep 0.5
done
"$1/build/spherical-mixture-fit" "$(sed 's/.* //' "$1/address")" 2.78 2.7 1.5 6
]])
run(sh ${WORK}/ask.sh ${WORK})
if(NOT said MATCHES "weight +kappa +mean direction\n +[01]\\.[0-9]+ +[0-9.e+]+ +")
  message(FATAL_ERROR "No table of lobes, but:\n${said}")
endif()
message(STATUS "${said}")
