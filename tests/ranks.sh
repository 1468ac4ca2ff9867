#!/bin/sh
# Ranks of `mpirun clvndf` on separate hosts, and how well two share the work.
#
#   ranks.sh BUILD WORK hosts           two network namespaces with a cable between them are two hosts (as root)
#   ranks.sh BUILD WORK speed [REPEAT]  one rank of one core beside two (default: 3 times, the best of each counts)
#
# BUILD: where it is built; WORK: a folder for what is made here.
# Exit status: 0 all is well, 1 not, 2 wrong arguments or nothing built, 77 something that it needs is missing.
set -u

cannot() {
    echo "ranks.sh: $*" >&2
    exit 2
}

[ $# -ge 3 ] || cannot "usage: ranks.sh BUILD WORK hosts|speed [REPEAT]"
build=$1 work=$2 what=$3 repeat=${4-3}
case $what in hosts | speed) ;; *) cannot "'$what': hosts and speed are what there is" ;; esac
[ -x "$build/clvndf" ] || cannot "no $build/clvndf: build it first (cmake --build $build --target clvndf)"
clvndf=$(cd "$build" && pwd)/clvndf
mkdir -p "$work" && cd "$work" || cannot "$work: cannot make this folder"
command -v mpirun >/dev/null || { echo "skipped: no mpirun"; exit 77; }
# As root; and in containers, whose ranks may not read each other's memory.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_vader_single_copy_mechanism=none
export POCL_CACHE_DIR="$PWD/cache"
status=0

# A report but for its times.
timeless() { sed 's/in [0-9.]* s:/in T s:/; s/; [0-9.]* s, seed/; T s, seed/; s/  *[0-9][0-9]*  none/ none/' "$1"; }

same() {
    if timeless "$2" >a && timeless "$3" >b && cmp -s a b; then
        echo "$1: the same"
    else
        echo "$1: NOT the same"
        diff a b | head -4
        status=1
    fi
}

hosts() {
    [ "$(id -u)" = 0 ] && command -v ip >/dev/null && command -v unshare >/dev/null ||
        { echo "skipped: needs root, ip (iproute2) and unshare"; exit 77; }
    one=clvndf-$$-1 two=clvndf-$$-2
    trap 'ip netns del $one; ip netns del $two' EXIT
    trap 'exit 1' INT TERM
    ip netns add $one && ip netns add $two &&
        ip link add eth0 netns $one type veth peer name eth0 netns $two || { echo "skipped: no network namespaces"; exit 77; }
    for host in 1 2; do
        ip -n clvndf-$$-$host addr add 10.77.0.$host/24 dev eth0
        ip -n clvndf-$$-$host link set eth0 up
        ip -n clvndf-$$-$host link set lo up
    done
    # In place of ssh: a command on the host of this address, which has a name of its own.
    cat >agent <<END
#!/bin/sh
host=\$1
shift
exec ip netns exec clvndf-$$-\${host##*.} unshare --uts sh -c "hostname host\${host##*.}; \$*"
END
    chmod +x agent
    on_hosts() {
        ./agent 10.77.0.1 cd "$PWD" \&\& exec mpirun --mca plm_rsh_agent "$PWD/agent" --mca btl self,tcp \
            --mca btl_tcp_if_include eth0 --mca oob_tcp_if_include eth0 \
            --mca oob_tcp_keepalive_time 5 --mca oob_tcp_keepalive_intvl 1 --mca oob_tcp_keepalive_probes 3 -H 10.77.0.1:1,10.77.0.2:1 -n 2 --bind-to none \
            -x POCL_CACHE_DIR "$@"
    }
    # Bytes between the hosts so far, both ways.
    sent() { ip netns exec $one cat /sys/class/net/eth0/statistics/tx_bytes /sys/class/net/eth0/statistics/rx_bytes | awk '{ n += $1 } END { print n }'; }

    on_hosts hostname | sort | tr '\n' ' '
    echo "are the hosts"
    for run in "check --quick --only vndf_ggx_sample_wm_dupuy2023" "check --exhaustive --only vndf_ggx_sample_wm_heitz2018 --slice 1/1000"; do
        "$clvndf" --quiet $run >alone
        before=$(sent)
        on_hosts "$clvndf" --quiet $run >together
        same "$run, $(($(sent) - before)) bytes between the hosts" alone together
    done
    render="render --size 200x150 --spp 8"
    "$clvndf" --quiet $render -o alone.png
    before=$(sent)
    on_hosts "$clvndf" --quiet $render -o together.png
    # All chunks but those of words.
    pixels() { python3 -c 'import sys; d=open(sys.argv[1],"rb").read(); i=8
while i < len(d):
    n=int.from_bytes(d[i:i+4],"big")+12
    if d[i+4:i+8] != b"tEXt": sys.stdout.buffer.write(d[i:i+n])
    i+=n' "$1"; }
    pixels alone.png >a.pixels && pixels together.png >b.pixels
    cmp a.pixels b.pixels && echo "$render, $(($(sent) - before)) bytes between the hosts: the same" || status=1

    # Of a benchmark the entries and what is no time; but not those for the noise between batches, of which there are more.
    bench="bench --quick --only vndf_ggx_g*/strict/float --repetitions 3 --json"
    figures() { python3 -c 'import json, sys
for b in json.load(open(sys.argv[1]))["benchmarks"]:
    if "_again" not in b["name"]: print(b["name"], b.get("err_p50"), b.get("err_p99"))' "$1" | sort; }
    "$clvndf" --quiet $bench alone.json >out && on_hosts "$clvndf" --quiet $bench together.json >out
    figures alone.json >a.figures && figures together.json >b.figures
    same "bench, $(wc -l <a.figures) times of $(grep -c best a.figures) entries" a.figures b.figures

    # The cable is cut in the middle: we notice, or mpirun does, which then ends what it can reach.
    (sleep 4; ip -n $one link set eth0 down) &
    on_hosts -x CLVNDF_RANK_TIMEOUT=3 "$clvndf" --quiet check --exhaustive --checkpoint at >out 2>err
    ended=$?
    if [ $ended != 0 ] && grep -q 'clvndf: rank 1 on host2 has been silent\|lost communication with a remote daemon' err &&
        [ ! -s out ]; then
        echo "a cut cable: status $ended, $(grep -m1 'clvndf:\|lost comm' err)"
    else
        echo "a cut cable: status $ended, NOT told: $(cat err)"
        status=1
    fi
}

# Of walks' checkpoints: million inputs a second, all together, from the build of the program to the last input.
rate() { python3 -c 'import json, sys
rates = (sum(s["inputs"] for s in j["samplers"]) / j["seconds"] for j in map(json.load, map(open, sys.argv[1:])))
print(round(sum(rates) / 1e6))' "$@"; }
best() { sort -g "$1" | tail -1; }

speed() {
    export POCL_MAX_PTHREAD_COUNT=1
    walk="$clvndf --quiet check --exhaustive --only *_wm_dupuy2023 --slice"
    # In sessions of their own, as ranks are, since Linux shares processors by sessions.
    one_rank() { setsid -w taskset -c $((i % 2)) $walk 1/200 --checkpoint one; }
    two_ranks() { mpirun -n 2 --map-by core --bind-to core $walk 1/200 --checkpoint two; }
    # Two processes that know nothing of each other, a half each: what the machine has to give just now.
    apart() {
        POCL_CACHE_DIR="$PWD/cache/rank-1" setsid -w taskset -c 1 $walk 201/400 --checkpoint second &
        setsid -w taskset -c 0 $walk 1/400 --checkpoint first
        wait
    }
    rm -f rates.*
    for i in $(seq 0 "$repeat"); do
        rm -f one two first second
        one_rank >out && two_ranks >out && apart >out || exit 1
        [ "$i" = 0 ] && continue # the first compiles
        rate one >>rates.one && rate two >>rates.two && rate first second >>rates.apart
        echo "run $i, million inputs a second: one rank $(tail -1 rates.one), two ranks $(tail -1 rates.two)," \
            "two processes apart $(tail -1 rates.apart)"
    done
    awk "BEGIN { printf \"efficiency of two ranks, best against best: %.2f of one rank's, %.2f of two processes apart\n\", \
        $(best rates.two) / $(best rates.one) / 2, $(best rates.two) / $(best rates.apart) }"
}

$what
exit $status
