#!/bin/sh
# Plugs the car in and waits until that is done. Ends with 0 when the plug is in.
#
#   PLUGPILOT_URL=http://plugpilot.local:8000 PLUGPILOT_TOKEN=... sh plug_in.sh
#
# The token is a key that may start and end jobs. An owner makes it on the home page: People and
# devices, Keys.
set -eu

api="${PLUGPILOT_URL:-http://127.0.0.1:8000}/api/v1"

: "${PLUGPILOT_TOKEN:?must hold a key of the robot}"

call() {
    curl --silent --show-error --fail-with-body --max-time 10 \
        --header "Authorization: Bearer $PLUGPILOT_TOKEN" "$@"
}

text_of() { # the value of a text field of flat JSON
    sed -n "s/.*\"$1\":\"\([^\"]*\)\".*/\1/p"
}

# The same key with the same body is the same job, however often it is sent.
key="plug-in-$(date +%Y%m%dT%H%M%S)-$$"
job=$(call --retry 3 --header "Content-Type: application/json" \
    --header "Idempotency-Key: $key" --data '{"type": "plug_in"}' "$api/jobs") || {
    printf '%s\n' "$job" # the problem, with what to do about it
    exit 1
}
id=$(printf '%s' "$job" | sed 's/^{"id":"\([^"]*\)".*/\1/')
echo "job $id"

while :; do
    job=$(call "$api/jobs/$id")
    state=$(printf '%s' "$job" | text_of state)
    phase=$(printf '%s' "$job" | text_of phase)
    echo "$state: $phase"
    case $state in
        succeeded) exit 0 ;;
        failed | cancelled)
            printf '%s' "$job" | text_of detail
            exit 1
            ;;
    esac
    sleep "${PLUGPILOT_PAUSE_S:-1}"
done
