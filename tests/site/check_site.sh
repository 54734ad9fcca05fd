#!/usr/bin/env bash
# docs/site/build makes the site and follows its links; a link that is broken on purpose is found; a folder with other files
# is left alone; search finds a page (where Chromium is). Skipped (77) without mkdocs.
# usage: check_site.sh SOURCE_DIR WORK_DIR
set -u
source=$1 work=$2
while read -r name probe; do
  case "$probe" in
    command:*) command -v "${probe#command:}" >/dev/null || { echo "$name is not here (cmake/debian-packages-site.txt): no site is made"; exit 77; } ;;
    file:*) [ -e "${probe#file:}" ] || { echo "$name is not here (cmake/debian-packages-site.txt): no site is made"; exit 77; } ;;
  esac
done <"$source/cmake/debian-packages-site.txt"
fail() { echo "$1"; exit 1; }
rm -rf "$work" && mkdir -p "$work/other" "$work/studio" || exit 1
: >"$work/other/mine"
echo '<!DOCTYPE html><title>a studio</title>' >"$work/studio/index.html"

"$source/docs/site/build" "$work/out" --studio "$work/studio" || fail "the site is not made"
[ -f "$work/out/studio/index.html" ] || fail "the studio is not in the site"
grep -q 'href="studio/index.html"' "$work/out/index.html" || fail "no link leads to the studio"
grep -q 'id="hf_pose_create"' "$work/out/include/hf/pose.html" || fail "the reference has no hf_pose_create"
"$source/docs/site/build" "$work/other" >/dev/null 2>&1 && fail "a folder with files of another was written"

sed -i 's/href="studio\/index.html"/href="nowhere.html"/' "$work/out/index.html"
python3 "$source/docs/site/check.py" "$work/out" >"$work/check.log" && fail "a link that leads nowhere is not found"
grep -q 'index.html: nowhere.html does not exist' "$work/check.log" || fail "the check does not name the link"

command -v chromium >/dev/null || { echo "no chromium here: search is not tried"; exit 0; }
# a page beside the site asks its search, and asks the server for /found?LINK when there is an answer
cat >"$work/out/ask.html" <<'HTML'
<!DOCTYPE html><iframe id="site" src="index.html?q=hf_geodesics_find_path" width="1200" height="800"></iframe><script>
setInterval(() => {
  const link = document.getElementById('site').contentDocument.querySelector('.md-search-result__list a')
  if (link) fetch('/found?' + link.href)
}, 500)
</script>
HTML
python3 -u -m http.server 0 -d "$work/out" --bind 127.0.0.1 >"$work/server.log" 2>&1 &
server=$!
for _ in $(seq 50); do grep -q 'port [0-9]' "$work/server.log" && break; sleep 0.1; done
port=$(sed -n 's/.*port \([0-9]*\).*/\1/p' "$work/server.log" | head -1)
chromium --headless --no-sandbox --disable-gpu --user-data-dir="$work/chromium" --remote-debugging-port=0 \
  "http://127.0.0.1:$port/ask.html" >"$work/chromium.log" 2>&1 &
browser=$!
trap 'kill $server $browser' EXIT
for _ in $(seq 120); do grep -q 'GET /found' "$work/server.log" && break; sleep 0.5; done
grep -q 'GET /found?.*include/hf/analysis.html' "$work/server.log" || fail "search does not find hf_geodesics_find_path"
echo "search finds the reference of a function"
