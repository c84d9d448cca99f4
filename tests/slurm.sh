#!/bin/bash
# A render in a queue of Slurm: slurm.sh PROGRAM ROOT SCRATCH. Starts a controller and three nodes on this
# machine, submits a render of seven shards by scripts/slurm/submit, kills a node in the middle of its
# shard, and puts another shard back into the queue. Slurm begins both again, they go on from their
# checkpoints, and the picture has the bits of one whose shards were left alone, and is that of a
# render without shards up to rounding. Exit 77: there is no Slurm here.
set -u
program=$(realpath "$1") root=$2 scratch=$3
for daemon in slurmctld slurmd sbatch idiff; do
    PATH=$PATH:/usr/sbin command -v $daemon >/dev/null || { echo "no $daemon"; exit 77; }
done
PATH=$PATH:/usr/sbin
rm -rf "$scratch"
mkdir -p "$scratch/state"
cd "$scratch" || exit 1
scratch=$PWD
failures=0
wrong() {
    echo "FAILED: $1"
    failures=$((failures + 1))
}

# descendants PID: the processes that it has begun, and theirs.
descendants() {
    local child
    for child in $(pgrep -P "$1"); do
        echo "$child"
        descendants "$child"
    done
}

# processes_of NODE: its jobs', and those of the daemons that watch these, first.
processes_of() {
    local pid parent
    for pid in $(pgrep -u "$(id -u)"); do
        { tr '\0' '\n' <"/proc/$pid/environ"; } 2>/dev/null | grep -qx "SLURM_CONF=$SLURM_CONF" || continue
        tr '\0' '\n' <"/proc/$pid/environ" 2>/dev/null | grep -qx "SLURMD_NODENAME=$1" || continue
        parent=$(ps -o ppid= -p "$pid" | tr -d ' ')
        [ "$(ps -o comm= -p "${parent:-0}")" = slurmstepd ] && echo "0 $parent"
        echo "1 $pid"
    done | sort -u | cut -d ' ' -f 2
}

# The daemons believe each other without munge, whose key is for a whole machine.
configure() {
    local host port=$((20000 + RANDOM % 20000)) node
    host=$(hostname -s)
    cat <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/none
CredType=cred/none
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1
ReturnToService=2
SlurmdTimeout=5
JobRequeue=1
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/%n
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/%n.pid
SlurmctldLogFile=$scratch/slurmctld.log
SlurmdLogFile=$scratch/%n.log
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
PartitionName=render Nodes=ALL Default=YES State=UP
CONF
    for node in 1 2 3; do
        echo "NodeName=node$node NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + node)) CPUs=1"
    done
}

declare -A daemons
start() { # NAME COMMAND...
    local name=$1
    shift
    "$@" >"$name.out" 2>&1 &
    daemons[$name]=$!
}

# shellcheck disable=SC2317 # called by trap
stop_all() {
    local name
    scancel --state=RUNNING --state=PENDING --user="$(id -un)" 2>/dev/null
    for name in "${!daemons[@]}"; do
        # shellcheck disable=SC2046
        kill $(descendants "${daemons[$name]}") "${daemons[$name]}" 2>/dev/null
    done
    wait
}

# wait_for SECONDS WHAT COMMAND...: until the command succeeds.
wait_for() {
    local left=$1 what=$2
    shift 2
    until "$@" 2>/dev/null; do
        left=$((left - 1))
        [ $left -gt 0 ] || { wrong "$what"; return 1; }
        sleep 1
    done
}

nodes_are_idle() { [ "$(sinfo --noheader --format=%D --states=idle)" = 3 ]; }

# running: "TASK NODE" of a shard that has written its checkpoint, on another node than $1.
running() {
    local task node
    squeue --noheader --states=RUNNING --name=clshear-shard --array --format='%K %N' |
        while read -r task node; do
            [ "$node" != "$1" ] && [ -s "img.exr.parts/$task.state" ] && echo "$task $node" && return
        done | grep .
}
restarts_of() { scontrol show job "${shards}_$1" | grep -o 'Restarts=[0-9]*' | grep -o '[0-9]*'; }
is_done() { scontrol show job "$last" | grep -q 'JobState=COMPLETED'; }

configure >slurm.conf
export SLURM_CONF=$scratch/slurm.conf CLSHEAR=$program CLSHEAR_EVERY=0 CLSHEAR_FAN=3
trap stop_all EXIT
start controller slurmctld -D
for node in node1 node2 node3; do
    mkdir -p $node
    start $node slurmd -D -N $node
done
wait_for 60 "the nodes are not there: $(sinfo)" nodes_are_idle || exit 1

flags=(--width 64 --height 64 --spp 114688 --replicates 7 --oracle centre --packet 8)
scene=$root/scenes/cornell.obj
last=$("$root/scripts/slurm/submit" 7 img.exr "$scene" "${flags[@]}") || exit 1
shards=$(squeue --noheader --name=clshear-shard --format=%F | sort -n | head -1)

found=
wait_for 120 "no shard has a checkpoint" eval 'found=$(running none)' || exit 1
read -r killed node <<<"$found"
# The node dies: its daemon, that of the job, and the render, all at once.
# shellcheck disable=SC2046
kill -9 "${daemons[$node]}" $(processes_of "$node")
echo "killed $node with shard $killed"
wait_for 120 "no other shard has a checkpoint" eval 'found=$(running '"$node"')' && {
    read -r requeued _ <<<"$found"
    scontrol requeue "${shards}_$requeued" && echo "requeued shard $requeued"
}
wait_for 400 "not done: $(squeue; sinfo)" is_done
[ "$(restarts_of "$killed")" -ge 1 ] || wrong "shard $killed was not begun again"
[ "$(restarts_of "$requeued")" -ge 1 ] || wrong "shard $requeued was not begun again"
for task in $killed $requeued; do
    [ "$(grep -c 'is not there yet' "img.exr.parts/shard-$task.log")" -eq 1 ] ||
        wrong "shard $task began from nothing again: $(cat "img.exr.parts/shard-$task.log")"
done
[ -s img.exr.parts/1.3.exr ] || wrong "the merge is no tree"

# The same shards in peace, merged by the same tree.
for k in 1 2 3 4 5 6 7; do
    "$program" "$scene" "${flags[@]}" --shard $k/7 --quiet --out $k.exr || wrong "shard $k in peace"
done
"$program" merge 1.exr 2.exr 3.exr --out a.exr
"$program" merge 4.exr 5.exr 6.exr --out b.exr
"$program" merge 7.exr --out c.exr
"$program" merge a.exr b.exr c.exr --out peace.exr
hash_of() { iinfo --hash "$1" | grep -o '[0-9A-F]\{40\}'; }
[ "$(hash_of img.exr)" = "$(hash_of peace.exr)" ] || wrong "other bits than shards that were left alone"
# Floats round by 6e-8 of a value; the light of the box is below 4.
"$program" "$scene" "${flags[@]}" --adaptive=0 --quiet --out whole.exr
for name in img whole; do
    oiiotool $name.exr --ch R,G,B -o $name.rgb.exr
done
idiff -fail 1e-6 whole.rgb.exr img.rgb.exr || wrong "other than the render without shards"
[ $failures -eq 0 ] && echo "all as expected"
exit $((failures > 0))
