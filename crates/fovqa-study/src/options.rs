//! Options of analyses that are words.

use fovqa_params::words;

words! {
    /// How tied votes count.
    #[derive(Default)]
    pub enum Ties {
        /// A tie is an error.
        #[default]
        Error "error" "a tie is an error";
        /// Tied votes are left out.
        Drop "drop" "tied votes are left out";
        /// A tie is half a vote for each side.
        Half "half" "a tie is half a vote for each side";
    }
}

words! {
    /// The test of each pair of methods.
    #[derive(Default)]
    pub enum PairwiseTest {
        /// Kruskal-Wallis test of the two methods alone.
        #[default]
        Kruskal "kruskal" "Kruskal-Wallis test of the two methods alone (VaFR)";
        /// Dunn's test, with the ranks of all methods.
        Dunn "dunn" "Dunn's test, with the ranks of all methods";
        /// Wilcoxon's signed-rank test of the units that have both methods.
        SignedRank "signed-rank" "Wilcoxon's signed-rank test of units with both methods";
    }
}

words! {
    /// The shape of a psychometric function.
    #[derive(Default)]
    pub enum Sigmoid {
        /// Logistic function.
        #[default]
        Logistic "logistic" "logistic function";
        /// Cumulative normal distribution.
        Gaussian "gaussian" "cumulative normal distribution";
        /// Weibull function of the logarithm of the level.
        Weibull "weibull" "Weibull function of the logarithm of the level";
    }
}

words! {
    /// How performance depends on the level.
    #[derive(Default)]
    pub enum Direction {
        /// Performance grows with the level.
        #[default]
        Increasing "increasing" "performance grows with the level";
        /// Performance falls with the level.
        Decreasing "decreasing" "performance falls with the level";
    }
}

words! {
    /// The mean of the levels at reversals.
    #[derive(Default)]
    pub enum LevelMean {
        /// Arithmetic mean.
        #[default]
        Arithmetic "arithmetic" "arithmetic mean of levels";
        /// Geometric mean.
        Geometric "geometric" "mean in the logarithm of the level";
    }
}

words! {
    /// What a binomial test looks for.
    #[derive(Default)]
    pub enum Alternative {
        /// The share differs from ½.
        #[default]
        TwoSided "two-sided" "the share differs from 1/2";
        /// The share is above ½.
        Greater "greater" "the share is above 1/2";
    }
}

words! {
    /// The smoothing of a grid of ratings.
    #[derive(Default)]
    pub enum Smoothing {
        /// No smoothing.
        #[default]
        None "none" "no smoothing";
        /// Weights \[1 2 1\] in both directions, over the cells that are present.
        Binomial "binomial" "weights [1 2 1] in both directions, over cells that are present";
    }
}
