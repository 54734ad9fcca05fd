/** A failure that a card shows: a sentence, and a way on. */
export class ModelError extends Error {
  constructor(message, advice = 'Export it again as glb, or take one of the samples.') {
    super(message);
    this.advice = advice;
  }
}
