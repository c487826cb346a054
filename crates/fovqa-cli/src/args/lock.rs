//! `--no-lock`.

use clap::Args;
use fovqa_engine::Locking;

#[derive(Debug, Clone, Args)]
pub(crate) struct LockArgs {
    /// Do not lock the results folder, for file systems without locks (some NFS and FUSE systems).
    /// Make sure that nothing else writes there at the same time
    #[arg(long)]
    pub(crate) no_lock: bool,
}

impl LockArgs {
    pub(crate) fn locking(&self) -> Locking {
        if self.no_lock { Locking::Unlocked } else { Locking::Locked }
    }
}
