# For other scripts, which source it after setting $build and making sure that emca-render is built:
#   serve SCENE [option of emca-render…]   serves scenes/SCENE and sets $address; ends the one before
#   stop_serving                           ends it; the end of the script does so, too
renderer=
serve_log=$(mktemp)
trap 'stop_serving; rm -f "$serve_log"' EXIT

stop_serving() {
  [ -n "$renderer" ] || return 0
  kill "$renderer" 2>/dev/null || true
  wait "$renderer" 2>/dev/null || true
  renderer=
}

serve() {
  stop_serving
  "$build/bin/emca-render" "scenes/$1/scene.xml" "${@:2}" --serve 0 >"$serve_log" 2>&1 &
  renderer=$!
  for _ in $(seq 300); do
    address=$(sed -n 's/^listening on //p' "$serve_log")
    [ -n "$address" ] && return
    kill -0 "$renderer" 2>/dev/null || { cat "$serve_log" >&2; exit 5; }
    sleep 0.1
  done
  echo "$(basename "$0"): the renderer did not begin to listen within 30 s" >&2
  exit 5
}
