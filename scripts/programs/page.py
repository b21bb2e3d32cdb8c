def write(docs, work, tried):
    pass
