# shellcheck shell=bash
# A cluster of Slurm for tests, on this machine: munged, slurmctld and two slurmd in a folder, on the loopback alone.
# Sourced. start_cluster FOLDER sets SLURM_CONF; stop_cluster ends the daemons that it started.

cluster_daemons=()

start_daemon() {
    local name="$1"
    shift
    "$@" >"$cluster/$name.out" 2>&1 &
    cluster_daemons+=("$!")
}

free_port() {
    python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}

write_slurm_conf() {
    local memory
    memory="$(awk '/MemTotal/ { print int($2 / 1024 / 2) }' /proc/meminfo)"
    cat >"$cluster/slurm.conf" <<END
ClusterName=espalier
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$cluster/munge.socket
CredType=cred/munge
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool.%n
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.%n.pid
SlurmctldLogFile=$cluster/slurmctld.log
SlurmdLogFile=$cluster/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerParameters=sched_interval=2,batch_sched_delay=0
MaxArraySize=21
TmpFS=$cluster/tmp.%n
SlurmdParameters=config_overrides
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
KillWait=30
InactiveLimit=0
NodeName=one NodeHostname=localhost NodeAddr=127.0.0.1 Port=$(free_port) CPUs=4 RealMemory=$memory State=UNKNOWN
NodeName=two NodeHostname=localhost NodeAddr=127.0.0.1 Port=$(free_port) CPUs=4 RealMemory=$memory State=UNKNOWN
PartitionName=all Nodes=one,two Default=YES MaxTime=INFINITE State=UP
END
    export SLURM_CONF="$cluster/slurm.conf"
}

start_cluster() {
    cluster="$1"
    mkdir -p "$cluster"/{state,spool.one,spool.two,tmp.one,tmp.two}
    chmod 755 "$cluster"
    (umask 077 && head -c 1024 /dev/urandom >"$cluster/munge.key")
    start_daemon munged munged --foreground --force --key-file="$cluster/munge.key" --socket="$cluster/munge.socket" \
        --pid-file="$cluster/munged.pid" --log-file="$cluster/munged.log" --seed-file="$cluster/munged.seed"
    write_slurm_conf
    for _ in {1..50}; do [[ -S $cluster/munge.socket ]] && break || sleep 0.1; done
    start_daemon slurmctld slurmctld -D -f "$SLURM_CONF"
    start_daemon slurmd.one slurmd -D -N one -f "$SLURM_CONF"
    start_daemon slurmd.two slurmd -D -N two -f "$SLURM_CONF"
    for _ in {1..100}; do
        [[ $(sinfo --noheader --format=%T 2>/dev/null) == idle ]] && return
        sleep 0.2
    done
    echo "the cluster does not start:" >&2
    tail -n 5 "$cluster"/*.out "$cluster"/*.log >&2
    return 1
}

stop_cluster() {
    local daemon
    scancel --user="$(id -un)" --full 2>/dev/null || true
    sleep 1
    for daemon in "${cluster_daemons[@]}"; do kill "$daemon" 2>/dev/null || true; done
    wait "${cluster_daemons[@]}" 2>/dev/null || true
}
