#!/bin/sh
# Photographs of a report's pages, wide and narrow, by day and by night, to be looked at before a release:
#   courant report --out courant-out && .ci/screenshots.sh courant-out screenshots
# Needs chromium, google-chrome or chrome on the path; says so and does nothing (exit 77) where there is none.
set -eu
pages=${1:?the folder of the report} out=${2:?the folder for the pictures}
for name in chromium chromium-browser google-chrome chrome; do
    if command -v "$name" > /dev/null; then browser=$name; break; fi
done
if [ -z "${browser:-}" ]; then
    echo "no browser is here (looked for chromium, chromium-browser, google-chrome, chrome): no screenshots" >&2
    exit 77
fi
mkdir -p "$out"
find "$pages" -name index.html | while read -r page; do
    place=$(dirname "${page#"$pages"}" | tr / _)
    for width in 1200 400; do
        for light in light dark; do
            # A window is never narrower than 500: a frame of the wanted width is.
            frame="$out/frame.html"
            printf '<!doctype html><meta name="color-scheme" content="light dark"><style>body{margin:0}iframe{border:0;width:%spx;height:3000px}</style><iframe src="file://%s"></iframe>' \
                "$width" "$(realpath "$page")" > "$frame"
            night=$([ "$light" = dark ] && echo --blink-settings=preferredColorScheme=0 || echo --blink-settings=preferredColorScheme=1)
            "$browser" --headless --no-sandbox --disable-gpu --hide-scrollbars --allow-file-access-from-files "$night" \
                --window-size="$((width > 500 ? width : 500)),3000" --virtual-time-budget=5000 \
                --screenshot="$(realpath "$out")/report${place%.}_${width}_$light.png" "file://$(realpath "$frame")" > /dev/null 2>&1
        done
    done
    rm -f "$out/frame.html"
done
ls "$out"
