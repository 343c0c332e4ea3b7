"""Systems, mechanisms and motions that tests hold the reference to, with their random states."""
