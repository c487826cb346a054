//! `--no-lock`.

use clap::Args;
use fovqa_engine::Locking;

#[derive(Debug, Clone, Args)]
pub(crate) struct LockArgs {
    /// Do not lock the folder of the results: for file systems without locks (some of NFS and FUSE).
    /// Nothing else may write there meanwhile
    #[arg(long)]
    pub(crate) no_lock: bool,
}

impl LockArgs {
    pub(crate) fn locking(&self) -> Locking {
        if self.no_lock { Locking::Unlocked } else { Locking::Locked }
    }
}
