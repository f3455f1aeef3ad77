"""A Slurm of four nodes on this machine, in a folder of its own.

    with slurm.Cluster(folder) as cluster: ...

Nodes n1 to n4 are four slurmd processes; there is no munge and no database. It
needs root, as slurmd does.
"""

import os
import pathlib
import signal
import socket
import subprocess
import time

NODES = 4
# After so many seconds of silence a node is lost.
TIMEOUT = 10
CONFIGURATION = """\
ClusterName=farm
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
AuthType=auth/none
CredType=cred/none
SlurmUser=root
SlurmdUser=root
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout={timeout}
# A job of a lost node begins again only when its credential has expired.
AuthInfo=cred_expire=6
# Slots that are free are filled at once: as it comes, every 2 or 3 s.
SchedulerParameters=sched_interval=1,batch_sched_delay=0,bf_interval=1
MaxArraySize=10001
MaxJobCount=20000
SlurmdParameters=config_overrides
StateSaveLocation={folder}/state
SlurmctldPidFile={folder}/slurmctld.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdSpoolDir={folder}/d-%n
SlurmdPidFile={folder}/d-%n.pid
SlurmdLogFile={folder}/d-%n.log
{nodes}
PartitionName=all Nodes=n[1-{count}] Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    """Ports that nobody listens on now."""
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """Slurm's daemons; `environment` makes its commands talk to them."""

    def __init__(self, folder, cpus=2):
        self.folder = pathlib.Path(folder)
        self.environment = dict(os.environ,
                                SLURM_CONF=str(self.folder / "slurm.conf"))
        host = socket.gethostname().split(".")[0]
        port, *of_nodes = free_ports(NODES + 1)
        nodes = "\n".join(
            f"NodeName=n{number} NodeHostname={host} NodeAddr=127.0.0.1 "
            f"Port={of_nodes[number - 1]} CPUs={cpus} State=UNKNOWN"
            for number in range(1, NODES + 1))
        (self.folder / "state").mkdir(parents=True)
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=host, port=port, folder=self.folder, nodes=nodes,
            count=NODES, timeout=TIMEOUT))
        self.daemons = {}

    def start(self, name, *command):
        log = open(self.folder / f"{name}.out", "w")
        self.daemons[name] = subprocess.Popen(
            command, env=self.environment, stdout=log, stderr=log,
            stdin=subprocess.DEVNULL, start_new_session=True)

    def start_node(self, number):
        (self.folder / f"d-n{number}").mkdir(exist_ok=True)
        self.start(f"n{number}", "slurmd", "-D", "-N", f"n{number}")

    def __enter__(self):
        self.start("slurmctld", "slurmctld", "-D", "-c", "-i")
        for number in range(1, NODES + 1):
            self.start_node(number)
        self.wait(lambda: self.call("sinfo", "-h", "-t", "idle", "-o", "%D")
                  .strip() == str(NODES), 60, "the nodes to be idle")
        return self

    def __exit__(self, *_):
        for daemon in reversed(self.daemons.values()):
            daemon.terminate()
        for daemon in self.daemons.values():
            daemon.wait(30)

    def call(self, *command):
        """What one of Slurm's commands prints, or what it says is wrong."""
        return subprocess.run(command, env=self.environment, text=True,
                              stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT).stdout

    def wait(self, done, seconds, what, every=0.2):
        """Until done(), asked every so often; raises TimeoutError after so
        many seconds."""
        end = time.monotonic() + seconds
        while not done():
            if time.monotonic() > end:
                raise TimeoutError(f"waited {seconds} s for {what}:\n"
                                   + self.call("sinfo") + self.call("squeue"))
            time.sleep(every)

    def lose_node(self, number):
        """Kills a node as a power cut does: its jobs, too, at once.

        First those who would tell that a job was killed, slurmd and its
        slurmstepd, which is the parent of a job's first process.
        """
        daemon = self.daemons.pop(f"n{number}")
        mine = {f"SLURMD_NODENAME=n{number}".encode(),
                f"SLURM_CONF={self.folder}/slurm.conf".encode()}
        workers, steps = [], set()
        for pid in filter(str.isdigit, os.listdir("/proc")):
            place = pathlib.Path("/proc") / pid
            try:
                if not mine <= set((place / "environ").read_bytes()
                                   .split(b"\0")):
                    continue
                parent = (place / "stat").read_text().rsplit(")", 1)[1].split(
                    )[1]
                workers.append(int(pid))
                if b"slurmstepd" in (place.parent / parent /
                                     "cmdline").read_bytes():
                    steps.add(int(parent))
            except OSError:
                continue
        for pid in [daemon.pid, *steps, *workers]:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        daemon.wait()

    def jobs(self):
        """How many lines Slurm has of what is waiting or at work; tasks of an
        array that wait are one."""
        return len(self.call("squeue", "-h").splitlines())
