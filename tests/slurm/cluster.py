# SPDX-License-Identifier: MIT
"""A throwaway Slurm cluster on loopback: real munged, slurmctld and one slurmd a node.

Needs root and Debian's packages slurm-wlm and munge; no systemd, cgroups or database. Debian builds
slurmd so that several can run on one machine, each under its own node name.
"""

import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

# Seconds; a node that is silent this long is down, and its jobs are requeued.
NODE_TIMEOUT = 10
# Ports that a default installation does not use (6817, 6818).
CONTROLLER_PORT = 16817
NODE_PORT = 16821


def missing():
    """Why no cluster can run here, or None."""
    for program in ("sbatch", "slurmctld", "slurmd", "munged"):
        if shutil.which(program, path=os.environ["PATH"] + ":/usr/sbin") is None:
            return f"{program} is not installed (packages slurm-wlm and munge)"
    if os.geteuid() != 0:
        return "starting slurmd needs root"
    return None


class Cluster:
    """Starts on construction; use as a context manager. Nodes are n1, n2, …, one CPU each."""

    def __init__(self, folder, nodes=2):
        self.folder = pathlib.Path(folder).resolve()
        self.nodes = [f"n{k + 1}" for k in range(nodes)]
        for name in ("state", "log", "munge"):
            (self.folder / name).mkdir(parents=True, exist_ok=True)
        self._start_munge()
        self.environment = dict(os.environ, SLURM_CONF=str(self._write_configuration()))
        self._run("/usr/sbin/slurmctld", "-c")
        for node in self.nodes:
            self.start_node(node)
        self._await_idle()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def _start_munge(self):
        munge = self.folder / "munge"
        (munge / "key").write_bytes(os.urandom(128))
        os.chmod(munge / "key", 0o600)
        shutil.chown(munge, "munge", "munge")
        shutil.chown(munge / "key", "munge", "munge")
        # munged refuses folders that others may write to, and every parent must let it through.
        for parent in munge.parents:
            if parent.stat().st_mode & 0o005 != 0o005:
                os.chmod(parent, parent.stat().st_mode | 0o005)
        subprocess.run(
            ["runuser", "-u", "munge", "--", "/usr/sbin/munged", "--force",
             f"--key-file={munge}/key", f"--socket={munge}/socket", f"--pid-file={munge}/pid",
             f"--log-file={munge}/log", f"--seed-file={munge}/seed"],
            check=True, stderr=subprocess.DEVNULL)

    def _write_configuration(self):
        host = socket.gethostname().split(".")[0]
        meminfo = pathlib.Path("/proc/meminfo").read_text().splitlines()
        total = next(int(line.split()[1]) // 1024 for line in meminfo if line.startswith("MemTotal"))
        memory = total // len(self.nodes) - 512
        last = NODE_PORT + len(self.nodes) - 1
        f = self.folder
        lines = f"""
            ClusterName=loopback
            SlurmctldHost={host}(127.0.0.1)
            SlurmctldPort={CONTROLLER_PORT}
            SlurmUser=root
            SlurmdUser=root
            AuthType=auth/munge
            AuthInfo=socket={f}/munge/socket,cred_expire=10
            StateSaveLocation={f}/state
            SlurmdSpoolDir={f}/%n.spool
            SlurmctldPidFile={f}/controller.pid
            SlurmdPidFile={f}/%n.pid
            SlurmctldLogFile={f}/log/controller.log
            SlurmdLogFile={f}/log/%n.log
            SlurmdTimeout={NODE_TIMEOUT}
            KillWait=2
            ProctrackType=proctrack/linuxproc
            TaskPlugin=task/none
            JobAcctGatherType=jobacct_gather/none
            AccountingStorageType=accounting_storage/none
            SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1
            MpiDefault=none
            SelectType=select/cons_tres
            SelectTypeParameters=CR_Core_Memory
            DefMemPerCPU=500
            MaxArraySize=100001
            MaxJobCount=200000
            ReturnToService=2
            JobRequeue=1
            RequeueExit=75
            NodeName=n[1-{len(self.nodes)}] NodeHostname={host} NodeAddr=127.0.0.1 Port=[{NODE_PORT}-{last}] CPUs=1 RealMemory={memory} State=UNKNOWN
            PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
            """
        path = self.folder / "slurm.conf"
        path.write_text("\n".join(line.strip() for line in lines.strip().splitlines()) + "\n")
        return path

    def _run(self, *command, check=True):
        return subprocess.run(command, env=self.environment, check=check, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=60).stdout

    def _await_idle(self):
        deadline = time.monotonic() + 30
        while self._run("sinfo", "-h", "-N", "-o", "%T", check=False).split() != ["idle"] * len(self.nodes):
            if time.monotonic() > deadline:
                raise RuntimeError("the cluster did not come up: see " + str(self.folder / "log"))
            time.sleep(0.1)

    def start_node(self, node):
        (self.folder / f"{node}.spool").mkdir(exist_ok=True)
        self._run("/usr/sbin/slurmd", "-N", node)

    def kill_node(self, node):
        """The node vanishes: its slurmd, job steps and their programs get SIGKILL."""
        victims = [int((self.folder / f"{node}.pid").read_text())]
        for step in self._run("pgrep", "slurmstepd", check=False).split():
            family = _family(int(step))
            if any(_environment(p).get("SLURMD_NODENAME") == node for p in family):
                victims += family
        for process in victims:
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def queue(self, job):
        """State of each task of the job that is still known: {array index: state}."""
        lines = self._run("squeue", "-h", "-r", "-j", str(job), "-o", "%K %T", check=False).split("\n")
        return dict(line.split() for line in lines if line)

    def queue_is_busy(self):
        return bool(self._run("squeue", "-h", check=False).strip())

    def cancel_all(self):
        self._run("scancel", "-f", "-u", "root", check=False)
        deadline = time.monotonic() + 30
        while self.queue_is_busy() and time.monotonic() < deadline:
            time.sleep(0.2)

    def stop(self):
        self.cancel_all()
        for path in [*self.folder.glob("n*.pid"), self.folder / "controller.pid",
                     self.folder / "munge" / "pid"]:
            try:
                os.kill(int(path.read_text()), signal.SIGTERM)
            except (OSError, ValueError):
                pass


def _family(process):
    """The process and all its descendants."""
    children = subprocess.run(["pgrep", "-P", str(process)], text=True, stdout=subprocess.PIPE,
                              check=False).stdout.split()
    return [process] + [p for child in children for p in _family(int(child))]


def _environment(process):
    try:
        entries = pathlib.Path(f"/proc/{process}/environ").read_text().split("\0")
    except OSError:
        return {}
    return dict(entry.split("=", 1) for entry in entries if "=" in entry)
