# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""What takes long lets the other threads of Python run."""
import sys
import threading
import unittest

import numpy as np

from credo import evidence
from credo.evidence import BinaryMass, Frame, MassFunction, RampBelief, batch

RANDOM = np.random.default_rng(1)
CELLS = RANDOM.dirichlet(np.ones(3), (300, 300))
FRAME = Frame.shafer(["A", "B", "C", "D"])
MASSES = [MassFunction(FRAME, zip(FRAME.propositions(), RANDOM.dirichlet(np.ones(15)))) for _ in range(3)]
MANY = Frame.shafer([str(i) for i in range(12)])
X = RANDOM.random(10000)
LONG = {
    "rules on arrays": lambda: batch.pcr5(CELLS, CELLS),
    "general rules": lambda: evidence.pcr5(MASSES),
    "folds": lambda: evidence.fold_in_order("pcr6", MASSES * 3),
    "closed forms by enumeration": lambda: evidence.pcr5([BinaryMass(0.3, 0.3)] * 9),
    "fits": lambda: evidence.fit_shape(X, X > 0.5, "match", "score", "1"),
    "shapes of arrays": lambda: RampBelief(max_yes=0.5)(X),
    "observations of many elements": lambda: MassFunction.generalized_bayes(MANY, np.full(12, 0.5)),
    "relations": lambda: evidence.most_plausible_relation(CELLS[:40, :40]),
}


class ThreadsTest(unittest.TestCase):
    def setUp(self):
        # Nobody is made to let others run: another thread does only where this one lets it.
        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        sys.setswitchinterval(1e6)

    def ran_during(self, work, times=1000):
        """Whether a thread that waits for its turn gets it while this one does nothing but work."""
        may_run, turns = threading.Lock(), []

        def wait():
            with may_run:
                turns.append(1)

        may_run.acquire()
        waiting = threading.Thread(target=wait)
        waiting.start()
        may_run.release()
        for _ in range(times):
            work()
            if turns:
                break
        ran = bool(turns)
        waiting.join()
        return ran

    def test_what_is_long_lets_others_run(self):
        for what, work in LONG.items():
            with self.subTest(what):
                self.assertTrue(self.ran_during(work))

    def test_the_test_can_fail(self):
        self.assertFalse(self.ran_during(lambda: BinaryMass(0.5, 0.2).discount(0.5)))

    def test_results_are_the_same_on_many_threads(self):
        expected, results = batch.pcr5(CELLS, CELLS[::-1]), [None] * 4

        def work(i):
            results[i] = batch.pcr5(CELLS, CELLS[::-1])

        threads = [threading.Thread(target=work, args=(i,)) for i in range(len(results))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results:
            np.testing.assert_array_equal(result, expected)


if __name__ == "__main__":
    unittest.main()
