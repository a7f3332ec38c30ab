# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""Credo in Python: `credo.evidence`, belief functions."""
