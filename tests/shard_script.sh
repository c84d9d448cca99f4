#!/bin/bash
# The task of an array, scripts/slurm/shard, without Slurm: shard_script.sh PROGRAM ROOT SCRATCH. Where Slurm
# says by SIGTERM that its time is nearly over, it writes the checkpoint and queues itself again, and the
# next one ends with the bits of a shard that was left alone.
set -u
program=$(realpath "$1") root=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch/bin" "$scratch/a folder"
cd "$scratch" || exit 1
wrong() {
    echo "FAILED: $1"
    exit 1
}
cat >bin/scontrol <<'END_OF_SCONTROL'
#!/bin/sh
echo "$@" >>scontrol.log
END_OF_SCONTROL
chmod +x bin/scontrol
export PATH=$scratch/bin:$PATH CLSHEAR=$program CLSHEAR_EVERY=0
export SLURM_ARRAY_TASK_ID=2 SLURM_JOB_ID=77 SLURM_CPUS_ON_NODE=2
flags=(--width 64 --height 64 --spp 8192 --oracle centre)
task() { exec "$root/scripts/slurm/shard" 2 "a folder" "$root/scenes/cornell.obj" "${flags[@]}"; }

task 2>first.log &
until [ -s "a folder/2.state" ] || ! kill -0 $! 2>/dev/null; do sleep 0.02; done
kill -TERM $!
wait $!
[ "$(cat scontrol.log)" = "requeue 77" ] || wrong "it does not queue itself again: $(cat first.log)"
[ -s "a folder/2.state" ] || wrong "no checkpoint is left"
(task) 2>second.log || wrong "the second time: $(cat second.log)"
grep -q "is not there yet" second.log && wrong "it begins anew"
[ ! -e "a folder/2.state" ] || wrong "a checkpoint is left"
"$program" "$root/scenes/cornell.obj" "${flags[@]}" --shard 2/2 --quiet --out peace.exr
hash_of() { iinfo --hash "$1" | grep -o '[0-9A-F]\{40\}'; }
[ "$(hash_of peace.exr)" = "$(hash_of 'a folder/0.2.exr')" ] || wrong "other bits"
[ "$(wc -l <scontrol.log)" -eq 1 ] || wrong "it queues itself again when it is done"
# What fails is the task's failure, and no reason to begin again.
flags=(--width 0)
(task) 2>third.log && wrong "a mistake in the flags is taken for a picture"
[ "$(wc -l <scontrol.log)" -eq 1 ] || wrong "it queues itself again with a mistake in its flags"
echo "all as expected"
